# The benches as tests (small, so that they cannot rot), and the comparison with VTK.
add_test(NAME bench.volume COMMAND bench_volume --samples 32 --pixels 64 --frames 2 --json)
set_tests_properties(bench.volume PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
    PASS_REGULAR_EXPRESSION "\"cases\":\\[{\"name\":.*\"ms\":.*\"psnr\":")

add_test(NAME bench.inside COMMAND bench_volume --technique all --samples 32 --pixels 64 --frames 1 --json)
set_tests_properties(bench.inside PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
    PASS_REGULAR_EXPRESSION "ie lit.*\"ms\":.*\"samples\":.*\"psnr\":")

if(TARGET voxsheet_vtk_peer)
    add_executable(bench_vs_vtk bench/bench_vs_vtk_main.cpp bench/bench_options.cpp)
    target_link_libraries(bench_vs_vtk PRIVATE voxsheet_volume_bench voxsheet_vtk_peer)
    voxsheet_warnings(bench_vs_vtk)
    set_target_properties(bench_vs_vtk PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/bench)
    add_test(NAME bench.vs_vtk COMMAND bench_vs_vtk --samples 32 --pixels 64 --frames 2 --json)
    set_tests_properties(bench.vs_vtk PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"cases\":\\[{\"name\":.*\"voxsheet_ms\":.*\"ratio_vtk_gpu\":")
endif()
