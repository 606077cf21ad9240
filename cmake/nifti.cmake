# SPDX-License-Identifier: GPL-3.0-or-later
# The library that reads NIfTI images, for weft's programs, as the target weft_nifti where it is installed.

find_path(WEFT_NIFTI_INCLUDE_DIR nifti1_io.h PATH_SUFFIXES nifti DOC "Folder of nifti1_io.h, for NIfTI images")
find_library(WEFT_NIFTIIO_LIBRARY niftiio DOC "The library niftiio, for NIfTI images")
find_library(WEFT_ZNZ_LIBRARY znz DOC "The library znz, which niftiio needs")
mark_as_advanced(WEFT_NIFTI_INCLUDE_DIR WEFT_NIFTIIO_LIBRARY WEFT_ZNZ_LIBRARY)
find_package(ZLIB QUIET)
if(WEFT_NIFTI_INCLUDE_DIR AND WEFT_NIFTIIO_LIBRARY AND WEFT_ZNZ_LIBRARY AND ZLIB_FOUND)
  add_library(weft_nifti INTERFACE)
  target_include_directories(weft_nifti SYSTEM INTERFACE ${WEFT_NIFTI_INCLUDE_DIR})
  target_link_libraries(weft_nifti INTERFACE ${WEFT_NIFTIIO_LIBRARY} ${WEFT_ZNZ_LIBRARY} ZLIB::ZLIB)
  target_compile_definitions(weft_nifti INTERFACE WEFT_LINKED_WITH_NIFTI HAVE_ZLIB)
  message(STATUS "weft's programs read NIfTI images through ${WEFT_NIFTIIO_LIBRARY}")
endif()
