# SPDX-License-Identifier: MIT
# Sets zvo_version to that of include/zvo/version.h, the one place that has it.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../include/zvo/version.h version_lines
     REGEX "^#define ZVO_VERSION_(MAJOR|MINOR|PATCH) [0-9]+$")
string(REGEX REPLACE "[^0-9]*([0-9]+)" "\\1." zvo_version "${version_lines}")
string(REGEX REPLACE "[.]$" "" zvo_version "${zvo_version}")
if(NOT zvo_version MATCHES "^[0-9]+[.][0-9]+[.][0-9]+$")
    message(FATAL_ERROR "include/zvo/version.h: no version in it, but '${zvo_version}'")
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/../include/zvo/version.h)
