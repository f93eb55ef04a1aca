if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # The storm's script takes the compiler more steps than it allows by itself.
  set_source_files_properties(storm_scenario_image.cpp PROPERTIES COMPILE_OPTIONS -fconstexpr-steps=100000000)
endif()

# palpate_hash_run(<target> <run> [<compiler option>...]): compiles the core anew with these options.
set(parts palpate_core_numeric palpate_core_elastic palpate_hal_phantom)
set(core_sources)
foreach(part IN LISTS parts)
  get_target_property(part_sources ${part} SOURCES)
  list(APPEND core_sources ${part_sources})
endforeach()
set(roots $<TARGET_PROPERTY:palpate_firmware_cycle,INTERFACE_INCLUDE_DIRECTORIES>)


function(palpate_hash_run target run)
  palpate_split_run(${run})
  add_executable(${target} hash_run.cpp ${image} ${core_sources})
  target_include_directories(${target} PRIVATE ${roots})
  target_link_libraries(${target} PRIVATE palpate_options Eigen3::Eigen)
  target_compile_definitions(${target} PRIVATE PALPATE_PROFILE=${profile})
  target_compile_options(${target} PRIVATE ${ARGN})
  target_link_options(${target} PRIVATE ${ARGN})
endfunction()

# palpate_golden_test(<name> <run> <ticks, or all> <program>)
function(palpate_golden_test name run ticks program)
  palpate_split_run(${run})
  set(limit)
  set(arguments)
  if(NOT ticks STREQUAL "all")
    set(limit -DTICKS=${ticks})
    set(arguments ${ticks})
  endif()
  set(may_update)
  if(name MATCHES "^golden\\.")
    set(may_update -DMAY_UPDATE=ON)
  endif()
  add_test(NAME determinism.${name}
    COMMAND ${CMAKE_COMMAND} -DGOLDEN=${golden} ${limit} ${may_update} -P ${compare} -- ${program} ${arguments})
  set_tests_properties(determinism.${name} PROPERTIES TIMEOUT 300)
endfunction()

# As the preset compiles it. Only the full run may write the golden files.
set(is_full TRUE)
if(PALPATE_CHECKED OR PALPATE_SANITIZE)
  set(is_full FALSE)
endif()
foreach(run ${runs})
  palpate_split_run(${run})
  set(program palpate_hash_run_${scenario}_${profile})
  add_executable(${program} hash_run.cpp ${image})
  target_link_libraries(${program} PRIVATE palpate_options palpate_firmware_cycle)
  target_compile_definitions(${program} PRIVATE PALPATE_PROFILE=${profile})
  if(is_full)
    palpate_golden_test(golden.${scenario}.${profile} ${run} all $<TARGET_FILE:${program}>)
  else()
    palpate_golden_test(first_ticks.${scenario}.${profile} ${run} ${first_ticks} $<TARGET_FILE:${program}>)
  endif()
endforeach()

# What the hand of the storm does, and 10^6 ticks of it in a soak.
add_executable(palpate_storm_test storm_test.cpp storm_scenario_image.cpp)
target_include_directories(palpate_storm_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/..)
target_link_libraries(palpate_storm_test PRIVATE palpate_options palpate_firmware_cycle GTest::gtest_main)
target_compile_definitions(palpate_storm_test PRIVATE PALPATE_PROFILE=CuboidDense)
add_test(NAME determinism.storm COMMAND palpate_storm_test)

# The comparison itself must be able to fail, and to say where.
add_test(NAME determinism.names_what_differs
  COMMAND ${CMAKE_COMMAND} -DGOLDEN=${CMAKE_CURRENT_SOURCE_DIR}/comparison/golden.csv -P ${compare} --
    ${CMAKE_COMMAND} -E cat ${CMAKE_CURRENT_SOURCE_DIR}/comparison/differs.csv)
set_tests_properties(determinism.names_what_differs PROPERTIES
  PASS_REGULAR_EXPRESSION "tick 200, stage forces: 23, but the golden hash is 22")
add_test(NAME determinism.refuses_a_short_run
  COMMAND ${CMAKE_COMMAND} -DGOLDEN=${CMAKE_CURRENT_SOURCE_DIR}/comparison/golden.csv -P ${compare} --
    ${CMAKE_COMMAND} -E cat ${CMAKE_CURRENT_SOURCE_DIR}/comparison/ends_early.csv)
set_tests_properties(determinism.refuses_a_short_run PROPERTIES
  PASS_REGULAR_EXPRESSION "printed 1 rows, but must print 2")

# The golden scenarios' integers are those that the model compiler makes of their SI values.
if(PALPATE_PROGRAM)
  foreach(run ${runs})
    palpate_split_run(${run})
    set(program palpate_golden_model_test_${scenario}_${profile})
    add_executable(${program} golden_model_test.cpp ${image})
    target_link_libraries(${program} PRIVATE palpate_options palpate_sim_model GTest::gtest_main)
    target_compile_definitions(${program} PRIVATE PALPATE_PROFILE=${profile})
    if(scenario STREQUAL "golden")
      target_sources(${program} PRIVATE golden_script_test.cpp)
    endif()
    add_test(NAME determinism.golden_model.${scenario}.${profile} COMMAND ${program})
  endforeach()
endif()

# Other compilations, once: not again for each preset.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU" OR NOT is_full)
  return()
endif()
palpate_hash_run(palpate_hash_run_O0 golden:CuboidPaper -O0)
palpate_golden_test(O0 golden:CuboidPaper ${first_ticks} $<TARGET_FILE:palpate_hash_run_O0>)
set_tests_properties(determinism.O0 PROPERTIES COST 60 LABELS slow)
foreach(run golden:CuboidPaper storm:CuboidDense)
  palpate_split_run(${run})
  palpate_hash_run(palpate_hash_run_${scenario}_O3 ${run} -O3)
  palpate_golden_test(${scenario}_O3 ${run} all $<TARGET_FILE:palpate_hash_run_${scenario}_O3>)
endforeach()

# palpate_skipped_test(<name> <reason>): shows in the list of tests as skipped.
function(palpate_skipped_test name reason)
  add_test(NAME determinism.${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${reason}")
  set_tests_properties(determinism.${name} PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped")
endfunction()

include(CheckCXXSourceRuns)
set(CMAKE_REQUIRED_FLAGS -m32)
check_cxx_source_runs("#include <array>\nint main() { return 0; }" PALPATE_RUNS_WITH_32_BITS)
unset(CMAKE_REQUIRED_FLAGS)
if(PALPATE_RUNS_WITH_32_BITS)
  foreach(run golden:CuboidPaper storm:CuboidDense)
    palpate_split_run(${run})
    palpate_hash_run(palpate_hash_run_${scenario}_32_bits ${run} -m32)
    palpate_golden_test(${scenario}_32_bits ${run} all $<TARGET_FILE:palpate_hash_run_${scenario}_32_bits>)
  endforeach()
else()
  palpate_skipped_test(32_bits "g++ -m32 (Debian: g++-multilib) makes no program that runs here; some kernels refuse 32 bits")
endif()

find_program(PALPATE_CLANG clang++)
if(PALPATE_CLANG)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/*.hpp ${PROJECT_SOURCE_DIR}/hal/*.hpp
    ${PROJECT_SOURCE_DIR}/firmware/cycle/*.hpp)
  set(clang_runs)
  foreach(run golden:CuboidPaper storm:CuboidDense)
    palpate_split_run(${run})
    set(clang_run ${CMAKE_CURRENT_BINARY_DIR}/palpate_hash_run_${scenario}_clang)
    # The storm's script takes the compiler more steps than it allows by itself.
    add_custom_command(OUTPUT ${clang_run}
      COMMAND ${PALPATE_CLANG} -std=c++17 -O2 -fconstexpr-steps=100000000 -DPALPATE_PROFILE=${profile}
        "-isystem$<JOIN:${roots},;-isystem>" ${CMAKE_CURRENT_SOURCE_DIR}/hash_run.cpp ${image} ${core_sources}
        -o ${clang_run}
      DEPENDS hash_run.cpp ${image} golden_body.hpp storm.hpp ${core_sources} ${headers}
      COMMENT "Compiling palpate_hash_run for ${scenario} with clang++"
      COMMAND_EXPAND_LISTS VERBATIM)
    list(APPEND clang_runs ${clang_run})
    palpate_golden_test(${scenario}_clang_O2 ${run} all ${clang_run})
  endforeach()
  add_custom_target(palpate_hash_run_with_clang ALL DEPENDS ${clang_runs})
else()
  palpate_skipped_test(clang_O2 "clang++ is not installed")
endif()
