# SPDX-License-Identifier: GPL-3.0-or-later
# Every public header starts with a paragraph about it, every public class and function has a comment, and every folder
# of public headers a line in rooms.txt. Members of classes needn't have a comment, if their names say it all.
#
#   cmake -D DOXYGEN=PROGRAM -D DOXYFILE=FILE -D SOURCE_DIR=FOLDER -P check_documented.cmake

cmake_minimum_required(VERSION 3.25)
set(complaints "")
file(GLOB_RECURSE headers RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/include/weft/*.h)
list(FILTER headers EXCLUDE REGEX "/internal/")
foreach(header IN LISTS headers)
  file(READ ${SOURCE_DIR}/${header} text LIMIT 200)
  if(NOT text MATCHES "^// SPDX[^\n]*\n//\n// [^\n]+\n")
    string(APPEND complaints "${header}: no paragraph about the header\n")
  endif()
endforeach()

file(STRINGS ${SOURCE_DIR}/doc/rooms.txt rooms REGEX "^[^#]+ \\| [^|]+ \\| [^|]+")
list(TRANSFORM rooms REPLACE " \\| .*" "")
foreach(header IN LISTS headers)
  cmake_path(GET header PARENT_PATH folder)
  string(REGEX REPLACE "^include/weft/?" "" folder "${folder}")
  if(folder AND NOT folder IN_LIST rooms)
    string(APPEND complaints "doc/rooms.txt: no line about the folder ${folder}\n")
    list(APPEND rooms ${folder})
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
