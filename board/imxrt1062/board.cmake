# i.MX RT1062, on a Teensy 4.1 or alone.
set(folders imxrt1062 device cortex_m)
set(sources
    imxrt1062/boot.cpp
    imxrt1062/clocks.cpp
    imxrt1062/converters.cpp
    imxrt1062/link.cpp
    imxrt1062/pins.cpp
    imxrt1062/system.cpp
    device/dwt.cpp
    device/exit.cpp)
set(timer device/systick.cpp)
set(device imxrt1062/gimbal.cpp imxrt1062/outputs.cpp imxrt1062/sensors.cpp imxrt1062/status.cpp)
set(lockstep_stream)
