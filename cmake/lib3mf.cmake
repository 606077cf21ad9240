# SPDX-License-Identifier: GPL-3.0-or-later
# The library that reads 3MF files, version 1.8 as in Debian, for weft's programs, as the target weft_lib3mf where it is
# installed.

find_path(WEFT_LIB3MF_INCLUDE_DIR Model/COM/NMR_DLLInterfaces.h PATH_SUFFIXES lib3mf
  DOC "Folder of Model/COM/NMR_DLLInterfaces.h, for 3MF files")
find_library(WEFT_LIB3MF_LIBRARY 3MF DOC "The library lib3MF, for 3MF files")
mark_as_advanced(WEFT_LIB3MF_INCLUDE_DIR WEFT_LIB3MF_LIBRARY)

if(WEFT_LIB3MF_INCLUDE_DIR AND WEFT_LIB3MF_LIBRARY)
  add_library(weft_lib3mf INTERFACE)
  target_include_directories(weft_lib3mf SYSTEM INTERFACE ${WEFT_LIB3MF_INCLUDE_DIR})
  target_link_libraries(weft_lib3mf INTERFACE ${WEFT_LIB3MF_LIBRARY})
  target_compile_definitions(weft_lib3mf INTERFACE WEFT_LINKED_WITH_LIB3MF)
  message(STATUS "weft's programs read 3MF files through ${WEFT_LIB3MF_LIBRARY}")
endif()
