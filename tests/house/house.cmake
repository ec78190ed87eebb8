# Checks of the house itself: layout of the sources, the installed package, equal bits everywhere.

# house_test(name label seconds command…): a script that skips with 77.
function(house_test name label seconds)
  add_test(NAME "house: ${name}" COMMAND ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties("house: ${name}" PROPERTIES LABELS ${label} TIMEOUT ${seconds}
                       SKIP_RETURN_CODE 77 ENVIRONMENT ${tumble_test_environment})
endfunction()

set(house ${CMAKE_CURRENT_SOURCE_DIR}/house)
house_test("sources are laid out as .clang-format says" quick 60 ${house}/format.sh)
house_test("scene files survive ten minutes of fuzzing" long 1800 ${house}/fuzz.sh)
if(TUMBLE_APP)
  if(NOT CMAKE_CXX_FLAGS_RELEASE MATCHES "march=native")  # there bits are not promised
    house_test("every demo gives its approved images and numbers" quick 1200
               $<TARGET_FILE:tumble> golden -o ${PROJECT_BINARY_DIR}/golden)
    # By far the longest of the quick ones: begun first, it leaves no core idle at the end.
    set_tests_properties("house: every demo gives its approved images and numbers" PROPERTIES COST 100)
  endif()
  house_test("the programs of API.md find the installed package and run" quick 600
             ${house}/consumer.sh ${PROJECT_BINARY_DIR})
  house_test("both compilers give the same bits at -O1 and -O3" long 3600
             ${house}/determinism.sh)
endif()
