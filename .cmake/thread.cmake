# Thread sanitizer with assertions. Our parallel loops run on a stand-in for oneTBB, which the
# sanitizer can see through; .ci/tsan/tbb/parallel_for.h says why. No VTK: its threads are its own.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_CXX_FLAGS "-I\"${CMAKE_CURRENT_LIST_DIR}/../.ci/tsan\"" CACHE STRING "")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g" CACHE STRING "")
set(VANTAGE_SANITIZE thread CACHE STRING "")
set(VANTAGE_BUILD_VTK OFF CACHE BOOL "")
set(VANTAGE_BUILD_APPS OFF CACHE BOOL "")
