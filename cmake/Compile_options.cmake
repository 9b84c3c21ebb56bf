# Warnings for the project's own sources only: never exported, never global. GCC takes an empty boost::optional, and what
# CGAL makes of Eigen's matrices, for unset variables as soon as it inlines them otherwise than usual (sanitizers).
add_library(selvedge_warnings INTERFACE)
target_compile_options(selvedge_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra -Wpedantic -Wshadow -Wno-maybe-uninitialized -Wno-unknown-warning-option>
  $<$<AND:$<BOOL:${SELVEDGE_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)

# The sources of a target are read, with every template that they instantiate and every warning, but no code is generated.
set(selvedge_read_only_launcher ${CMAKE_CURRENT_LIST_DIR}/read_only.sh)
function(selvedge_read_only target)
  set(launcher ${selvedge_read_only_launcher} ${CMAKE_CXX_COMPILER_LAUNCHER})
  set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER "${launcher}")
endfunction()

# In a unity build, the sources of a target that are in one folder are compiled as one.
function(selvedge_unite_by_folder target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(source ${source} ABSOLUTE)
    get_filename_component(folder ${source} DIRECTORY)
    get_filename_component(folder ${folder} NAME)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# As above, with the folders of each list, in one string, as one source. A folder of no list is an error.
function(selvedge_unite_folders target)
  selvedge_unite_by_folder(${target})
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_source_file_property(folder ${source} UNITY_GROUP)
    set(group "")
    foreach(folders IN LISTS ARGN)
      if(" ${folders} " MATCHES " ${folder} ")
        string(REPLACE " " "_" group ${folders})
      endif()
    endforeach()
    if(NOT group)
      message(FATAL_ERROR "${source}: no unit of the unity build has the folder ${folder}; add it to one")
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# For code that goes into a shared library. Without interposition, functions are inlined as in a program.
set(SELVEDGE_POSITION_INDEPENDENT $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-fPIC$<SEMICOLON>-fno-semantic-interposition>)
