# Warnings for the project's own sources only: never exported, never global. GCC takes an empty boost::optional, and what
# CGAL makes of Eigen's matrices, for unset variables as soon as it inlines them otherwise than usual (sanitizers).
add_library(selvedge_warnings INTERFACE)
target_compile_options(selvedge_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra -Wpedantic -Wshadow -Wno-maybe-uninitialized -Wno-unknown-warning-option>
  $<$<AND:$<BOOL:${SELVEDGE_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)
