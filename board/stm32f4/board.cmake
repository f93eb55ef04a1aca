# STM32F405 and F407.
set(folders stm32f4 stm32 device cortex_m)
set(sources stm32f4/chip.cpp stm32f4/clocks.cpp stm32/link.cpp stm32/system.cpp device/dwt.cpp device/exit.cpp)
set(timer device/systick.cpp)
set(device stm32/outputs.cpp stm32/sensors.cpp stm32/status.cpp)
set(lockstep_stream)
