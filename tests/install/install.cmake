# Installs the build to PREFIX, and looks at what came: the headers, the libraries, the package, the program, no more.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${PREFIX})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX})

set(expected
  "^include/palpate/(numeric|memory|mesh|elastic|remesh|solve|touch|embed|tick|ports|phantom|container|firmware|link|safety|telemetry)/[a-z0-9_]+\\.hpp$"
  "^lib[^/]*(/[^/]+-linux-gnu)?/libpalpate_(core|hal)_[a-z]+\\.a$"
  "^lib[^/]*(/[^/]+-linux-gnu)?/cmake/palpate/palpate-[a-z-]+\\.cmake$"
  "^share/doc/palpate/LICENSE$"
  "^bin/palpate$")
file(GLOB_RECURSE files RELATIVE ${PREFIX} ${PREFIX}/*)
foreach(file IN LISTS files)
  set(known FALSE)
  foreach(pattern IN LISTS expected)
    if(file MATCHES "${pattern}")
      set(known TRUE)
    endif()
  endforeach()
  if(NOT known)
    message(FATAL_ERROR "${file} is installed, but is not for users")
  endif()
endforeach()
foreach(header numeric/q tick/tick phantom/premium ports/encoders container/chunk_reader firmware/cycle link/frame_reader safety/safety telemetry/ring)
  if(NOT "include/palpate/${header}.hpp" IN_LIST files)
    message(FATAL_ERROR "palpate/${header}.hpp is not installed")
  endif()
endforeach()
if("bin/palpate" IN_LIST files)
  run(${PREFIX}/bin/palpate --version)
  message(STATUS "${output}")
endif()
list(LENGTH files count)
message(STATUS "${count} files are installed")
