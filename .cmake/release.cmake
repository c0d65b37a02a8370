# Fast code, everything built: what users get and what tests/run.sh tests.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(VANTAGE_WRAP_PYTHON ON CACHE BOOL "")
