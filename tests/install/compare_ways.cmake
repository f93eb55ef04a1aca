# The examples printed the same, to the last bit of the state hash, whichever way they got the library.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
foreach(example hold_a_corner one_cycle)
  run(${CMAKE_COMMAND} -E compare_files ${WORK}/package/${example}.csv ${WORK}/subdirectory/${example}.csv)
endforeach()
