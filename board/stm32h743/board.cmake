# STM32H743, on a NUCLEO-H743ZI or alone.
set(folders stm32h743 stm32 device cortex_m)
set(sources
    stm32h743/chip.cpp
    stm32h743/clocks.cpp
    stm32/link.cpp
    stm32/system.cpp
    device/boot_vectors.cpp
    device/dwt.cpp
    device/exit.cpp)
set(timer device/systick.cpp)
set(device stm32/outputs.cpp stm32/sensors.cpp stm32/status.cpp)
set(lockstep_stream)
