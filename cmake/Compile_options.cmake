# Warnings for the project's own sources only: never exported, never global.
add_library(selvedge_warnings INTERFACE)
target_compile_options(selvedge_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra -Wpedantic -Wshadow -Wno-unknown-warning-option>
  $<$<AND:$<BOOL:${SELVEDGE_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)
