# The preset's board with the golden scenarios instead of its own, in QEMU. A Cortex-M4 has memory for Small only, and
# a Cortex-M7 is there for the other profiles.
set(PALPATE_HASH_EVERY 100)
string(REPLACE _ - machine ${PALPATE_BOARD})
if(PALPATE_BOARD STREQUAL "mps2_an386")
  list(FILTER runs INCLUDE REGEX ":Small$")
else()
  list(FILTER runs EXCLUDE REGEX ":Small$")
endif()
foreach(run ${runs})
  palpate_split_run(${run})
  palpate_script_firmware(palpate_${scenario} ${profile} ${image})
  add_test(NAME determinism.${scenario}_in_qemu
    COMMAND ${CMAKE_COMMAND} -DGOLDEN=${golden} -P ${compare} --
      ${PROJECT_SOURCE_DIR}/board/mps2/run_in_qemu ${machine} $<TARGET_FILE:palpate_${scenario}>)
  set_tests_properties(determinism.${scenario}_in_qemu PROPERTIES TIMEOUT 300)
endforeach()
