# Assertions on, fast enough to work with, warnings are errors.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g -Werror" CACHE STRING "") # without -DNDEBUG
