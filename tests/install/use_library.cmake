# Builds and runs docs/examples with the library as a WAY: package or subdirectory.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
set(build ${WORK}/${WAY})
file(REMOVE_RECURSE ${build})
if(WAY STREQUAL "package")
  set(library -DCMAKE_PREFIX_PATH=${PREFIX})
else()
  set(library -DPALPATE_SOURCES=${SOURCES})
endif()
run(${CMAKE_COMMAND} -S ${SOURCES}/docs/examples -B ${build} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
  "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wconversion -Wsign-conversion -Wshadow" -DCMAKE_COMPILE_WARNING_AS_ERROR=ON
  ${library})
run(${CMAKE_COMMAND} --build ${build})

# The bar pulls against the pull: to -x at the corner, to -y after the turret's turn.
run(${build}/hold_a_corner)
file(WRITE ${build}/hold_a_corner.csv "${output}")
if(NOT output MATCHES "\n1000,-[0-9]+,")
  message(FATAL_ERROR "hold_a_corner ends with no force to -x:\n${output}")
endif()
run(${build}/one_cycle)
file(WRITE ${build}/one_cycle.csv "${output}")
if(NOT output MATCHES "\n1000,-?[0-9]+,-[0-9]+,.*\nstate,[0-9a-f]+\n$")
  message(FATAL_ERROR "one_cycle ends with no force to -y, or with no state hash:\n${output}")
endif()
