# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Configures a project with an installed package that says it was built with another version of CGAL, and with the package as it is.
# The former must warn, for the library alone, and the latter not.
function(configure name source is_warning_wanted)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR}/${source} -B ${FOLDER}/${source}_${name} ${OPTIONS}
            -DCMAKE_PREFIX_PATH=${FOLDER}/${name}
    ERROR_VARIABLE messages OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "[ \n]+" " " messages "${messages}")
  string(FIND "${messages}" "The selvedge library was built with CGAL" found)
  if((found EQUAL -1 AND is_warning_wanted) OR (found GREATER -1 AND NOT is_warning_wanted))
    message(FATAL_ERROR "${name}, ${source}: ${messages}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(COPY ${PREFIX}/ DESTINATION ${FOLDER}/same)
file(COPY ${PREFIX}/ DESTINATION ${FOLDER}/other)
file(GLOB_RECURSE config ${FOLDER}/other/selvedge-config.cmake)
file(READ ${config} text)
string(REPLACE "CGAL_VERSION \"${VERSION}\"" "CGAL_VERSION \"5.5.9\"" text "${text}")
file(WRITE ${config} "${text}")
configure(same find_package FALSE)
configure(other find_package TRUE)
configure(other find_policies FALSE)
