# Compiles layout.cpp for a target with the fingerprints that LAYOUT prints.
execute_process(COMMAND ${LAYOUT} OUTPUT_VARIABLE fingerprints COMMAND_ERROR_IS_FATAL ANY)
list(TRANSFORM INCLUDES PREPEND -I)
execute_process(
  COMMAND ${COMPILER} -std=c++17 -mcpu=${PROCESSOR} -mthumb -mfloat-abi=soft -fno-exceptions -fno-rtti -fsyntax-only
          -DPALPATE_TARGET ${INCLUDES} -include palpate/numeric/platform.hpp ${fingerprints} ${SOURCE}
  COMMAND_ERROR_IS_FATAL ANY)
