# Every policy instantiated, by each standard of C++ and with more warnings. `all_headers.h` is in ALL_HEADERS_FOLDER.
foreach(standard 17 20 23)
  set(name every_policy_cxx${standard})
  add_library(${name} OBJECT ${CMAKE_CURRENT_LIST_DIR}/every_policy.cpp)
  set_target_properties(${name} PROPERTIES CXX_STANDARD ${standard} CXX_EXTENSIONS OFF)
  target_include_directories(${name} PRIVATE ${ALL_HEADERS_FOLDER})
  target_link_libraries(${name} PRIVATE selvedge::policies selvedge_warnings)
  target_compile_options(${name} PRIVATE -O0 -Wconversion -Wsign-conversion)
endforeach()
