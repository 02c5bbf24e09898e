include("${PROJECT_SOURCE_DIR}/cmake/ao_fault.cmake")

# ao_plant_bake(name source file "right" "wrong" "test case"): with the fault in backends/cpu/src/<file>, which <source> is or
# includes, the raster's tests must fail. The right text must occur once, so that a fault cannot get lost when the source changes.
function(ao_plant_bake name source file right wrong case)
    set(from "${PROJECT_SOURCE_DIR}/backends/cpu/src")
    set(copy "${CMAKE_CURRENT_BINARY_DIR}/planted/${name}/src")
    # Headers include their neighbours: all of them move.
    file(GLOB headers RELATIVE "${from}" CONFIGURE_DEPENDS "${from}/bake_*.hpp")
    foreach(each IN LISTS source headers)
        configure_file("${from}/${each}" "${copy}/${each}" COPYONLY)
    endforeach()
    file(READ "${from}/${file}" text)
    ao_fault(text "${file}" "${name}" "${right}" "${wrong}")
    file(WRITE "${copy}/${file}" "${text}")
    # What is linked as an object is not taken from the library.
    add_executable(planted_${name} unit/cpu_bake_closed.cpp "${copy}/${source}")
    target_include_directories(planted_${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests" "${copy}" "${from}")
    target_link_libraries(planted_${name} PRIVATE ao_test_main ao_cpu)
    add_test(NAME planted_${name} COMMAND planted_${name} "${case}")
    set_tests_properties(planted_${name} PROPERTIES
        LABELS unit TIMEOUT 600 PASS_REGULAR_EXPRESSION "FAILED:" ENVIRONMENT "${AO_TEST_ENVIRONMENT}")
endfunction()

ao_plant_bake(bake_border bake_closed.cpp bake_closed.cpp "if (sum != 0) {" "if (false) {" "a canopy*")
ao_plant_bake(bake_winding bake_closed.cpp bake_closed.cpp "winding_[i] != 0 || unsure_[i] != 0" "unsure_[i] != 0" "slivers*")
ao_plant_bake(bake_near bake_closed.cpp bake_closed.cpp "if (near && squared_distance" "if (false && squared_distance" "starts within*")
ao_plant_bake(bake_edge bake_closed.cpp bake_closed.cpp
    "if (!inside || std::abs(moment) < 1e-9 * std::abs(area) + 1e-14) {
            unsure_[i] = 1;"
    "if (!inside || std::abs(moment) < 1e-9 * std::abs(area) + 1e-14) {" "starts whose*")
ao_plant_bake(bake_doubt bake_kernels_scalar.cpp bake_raster.hpp "if (is_doubtful(m)) {" "if (false) {" "slivers*")
ao_plant_bake(bake_both_sides bake_kernels_scalar.cpp bake_raster_cover.hpp
    ">= Real(0.75F) * reals::abs(c.area) ||" "< Real(0.0F) ||" "slivers*")
