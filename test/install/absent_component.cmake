# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Configures a project that asks an installed package for its library, where headers alone are installed. The error says so.
file(REMOVE_RECURSE ${FOLDER})
file(COPY ${PREFIX}/ DESTINATION ${FOLDER}/headers PATTERN "selvedge-library*" EXCLUDE)
file(WRITE ${FOLDER}/project/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES CXX)
find_package(selvedge REQUIRED COMPONENTS library)
")
execute_process(
  COMMAND ${CMAKE_COMMAND} -G ${GENERATOR} -S ${FOLDER}/project -B ${FOLDER}/build ${OPTIONS} -DCMAKE_PREFIX_PATH=${FOLDER}/headers
  RESULT_VARIABLE result ERROR_VARIABLE messages OUTPUT_QUIET)
string(REGEX REPLACE "[ \n]+" " " messages "${messages}")
string(FIND "${messages}" "The component library is not in" found)
if(result EQUAL 0 OR found EQUAL -1)
  message(FATAL_ERROR "${messages}")
endif()
