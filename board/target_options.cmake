# What every part is compiled with on a target. The force-included header ends by making the words float and
# double errors. Unaligned accesses are off because the timing bound has no cost for them. Without peephole2 no
# list of loads is made of single ones: it may take an address on the stack, and then the bound takes every store for one
# that may be to the stack.
set(palpate_processor_mps2_an500 cortex-m7)
set(palpate_processor_mps2_an386 cortex-m4)
set(palpate_processor_stm32h743 cortex-m7)
set(palpate_processor_imxrt1062 cortex-m7)
set(palpate_processor_stm32f4 cortex-m4)
set(palpate_processor ${palpate_processor_${PALPATE_BOARD}})
if(NOT palpate_processor)
  message(FATAL_ERROR "palpate: no board is called '${PALPATE_BOARD}'; choose host, mps2_an500, mps2_an386, "
                      "stm32h743, imxrt1062 or stm32f4")
endif()
if(NOT CMAKE_SYSTEM_NAME STREQUAL "Generic")
  message(FATAL_ERROR "palpate: board '${PALPATE_BOARD}' needs the cross compiler: use a preset (cmake --preset m7) "
                      "or -DCMAKE_TOOLCHAIN_FILE=board/arm_none_eabi.cmake")
endif()

set(palpate_processor_options -mcpu=${palpate_processor} -mthumb -mfloat-abi=soft)
target_compile_options(
  palpate_options
  INTERFACE ${palpate_processor_options}
            -fno-exceptions
            -fno-rtti
            -fno-threadsafe-statics
            -fno-unwind-tables
            -fno-asynchronous-unwind-tables
            -ffunction-sections
            -fdata-sections
            -mno-unaligned-access
            -mslow-flash-data
            -fno-tree-loop-distribute-patterns
            -fno-ipa-cp-clone
            -fno-peephole2
            "SHELL:-include palpate/numeric/platform.hpp")
target_compile_definitions(palpate_options INTERFACE PALPATE_TARGET)
target_link_options(palpate_options INTERFACE ${palpate_processor_options})
