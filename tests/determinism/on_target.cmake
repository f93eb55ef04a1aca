# The preset's firmware with the golden scenario instead of its own, in QEMU.
set(PALPATE_HASH_EVERY 100)
palpate_firmware(palpate_golden ${PALPATE_PROFILE} ${image})

string(REPLACE _ - machine ${PALPATE_BOARD})
add_test(NAME determinism.golden_in_qemu
  COMMAND ${CMAKE_COMMAND} -DGOLDEN=${golden_${PALPATE_PROFILE}} -P ${compare} --
    ${PROJECT_SOURCE_DIR}/board/mps2/run_in_qemu ${machine} $<TARGET_FILE:palpate_golden>)
set_tests_properties(determinism.golden_in_qemu PROPERTIES TIMEOUT 300)
