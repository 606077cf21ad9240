# SPDX-License-Identifier: GPL-3.0-or-later
# Every public header starts with a paragraph about it, and every public class and function has a comment. Members of
# classes needn't, if their names say it all. What was measured on models is in doc/measured_*.md: comments name none of
# them, but for files in examples of use.
#
#   cmake -D DOXYGEN=PROGRAM -D DOXYFILE=FILE -D SOURCE_DIR=FOLDER -P check_documented.cmake

set(complaints "")
file(GLOB_RECURSE headers RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/include/weft/*.h)
foreach(header IN LISTS headers)
  file(STRINGS ${SOURCE_DIR}/${header} lines
    REGEX "//.*(elephant|armadillo|dinosaur|bunny|homer|fandisk|turbine|dragknob|femur)")
  list(FILTER lines EXCLUDE REGEX "^//   ")
  foreach(line IN LISTS lines)
    string(APPEND complaints "${header}: measured on a model: ${line}\n")
  endforeach()
endforeach()
list(FILTER headers EXCLUDE REGEX "/internal/")
foreach(header IN LISTS headers)
  file(READ ${SOURCE_DIR}/${header} text LIMIT 200)
  if(NOT text MATCHES "^// SPDX[^\n]*\n//\n// [^\n]+\n")
    string(APPEND complaints "${header}: no paragraph about the header\n")
  endif()
endforeach()

file(READ ${DOXYFILE} settings)
file(WRITE ${DOXYFILE}.documented "${settings}
EXTRACT_ALL = NO
WARN_IF_UNDOCUMENTED = YES
WARN_AS_ERROR = NO
GENERATE_HTML = NO
GENERATE_TAGFILE = ${DOXYFILE}.tags
")
execute_process(COMMAND ${DOXYGEN} ${DOXYFILE}.documented ERROR_VARIABLE warnings OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]* is not documented[^\n]*" undocumented "${warnings}")
list(FILTER undocumented EXCLUDE REGEX "Member .* of (class|struct) |::Rebind_TDS ") # what CGAL's bases have to have
list(JOIN undocumented "\n" undocumented)
string(APPEND complaints "${undocumented}")
if(complaints)
  message(FATAL_ERROR "${complaints}")
endif()
