# cmake -DCOMPILER= -DSOURCE= -DINCLUDES=a|b -P expect_message.cmake
# Compiles SOURCE and holds the outcome against its first line.
file(STRINGS ${SOURCE} first_line LIMIT_COUNT 1)
if(NOT first_line MATCHES "^// expect: (.+)$")
  message(FATAL_ERROR "${SOURCE} must begin with `// expect: <regex>` or `// expect: success`")
endif()
set(expected "${CMAKE_MATCH_1}")

set(flags -std=c++17 -fsyntax-only)
string(REPLACE "|" ";" directories "${INCLUDES}")
foreach(directory IN LISTS directories)
  list(APPEND flags -isystem ${directory})
endforeach()
set(ENV{LC_ALL} C)
execute_process(COMMAND ${COMPILER} ${flags} ${SOURCE} RESULT_VARIABLE result OUTPUT_VARIABLE output
  ERROR_VARIABLE output)

if(expected STREQUAL "success")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${SOURCE} must compile, but:\n${output}")
  endif()
elseif(result EQUAL 0)
  message(FATAL_ERROR "${SOURCE} must not compile")
elseif(NOT output MATCHES "${expected}")
  message(FATAL_ERROR "${SOURCE} must be refused with `${expected}`, but the compiler says:\n${output}")
endif()
