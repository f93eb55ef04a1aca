# MPS2 with the AN386 image, a Cortex-M4: without a device.
set(folders mps2_an386 mps2 cortex_m)
set(sources mps2_an386/core.cpp mps2/system.cpp mps2/cycle_counter.cpp)
set(timer mps2/tick_timer.cpp)
set(device)
set(lockstep_stream mps2/lockstep_stream.cpp)
