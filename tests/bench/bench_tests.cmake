# The benches as tests (small, so that they cannot rot), and the comparison with VTK.
add_test(NAME bench.volume COMMAND bench_volume --samples 32 --pixels 64 --frames 2 --json)
set_tests_properties(bench.volume PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
    PASS_REGULAR_EXPRESSION "\"cases\":\\[{\"name\":.*\"ms\":.*\"psnr\":")

add_test(NAME bench.inside COMMAND bench_volume --technique all --samples 32 --pixels 64 --frames 1 --json)
set_tests_properties(bench.inside PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
    PASS_REGULAR_EXPRESSION "ie lit.*\"ms\":.*\"samples\":.*\"psnr\":")

if(TARGET voxsheet_vtk_peer AND TARGET voxsheet_import)
    add_executable(bench_vs_vtk bench/bench_vs_vtk_main.cpp bench/cells_vs_vtk.cpp bench/inside_vs_vtk.cpp bench/bench_options.cpp
        bench/scan_fields.cpp bench/volume_vs_vtk.cpp bench/vs_vtk_result.cpp)
    target_link_libraries(bench_vs_vtk PRIVATE voxsheet_volume_bench voxsheet_vtk_peer voxsheet_import)
    voxsheet_warnings(bench_vs_vtk)
    set_target_properties(bench_vs_vtk PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/bench)
    add_test(NAME bench.vs_vtk COMMAND bench_vs_vtk --samples 32 --pixels 64 --frames 2 --json)
    set_tests_properties(bench.vs_vtk PROPERTIES LABELS bench TIMEOUT 240 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"cases\":\\[{\"name\":.*\"voxsheet_ms\":.*\"ratio_vtk_gpu\":")
    # Only what is chosen is made: a volume of 512^3 would take longer than this test may.
    add_test(NAME bench.vs_vtk_chosen COMMAND bench_vs_vtk --large --samples 32 --pixels 64 --frames 1 --only "32^3 u8 64x64 filled mip" --json)
    set_tests_properties(bench.vs_vtk_chosen PROPERTIES LABELS bench TIMEOUT 30 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"cases\":\\[{\"name\":\"32\\^3 u8 64x64 filled mip\",[^{]*}\\]}")
    add_test(NAME bench.vs_vtk_scans COMMAND bench_vs_vtk --scans ${CMAKE_SOURCE_DIR}/../shared/data --pixels 64 --frames 2
        --only neghip --json)
    set_tests_properties(bench.vs_vtk_scans PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"name\":\"neghip 64x64 sparse.*\"name\":\"neghip 64x64 filled"
        SKIP_REGULAR_EXPRESSION "error: --scans .*it has none of the scans")
endif()

if(TARGET bench_time_n)
    # Small volumes and budgets, so that textures are swapped and volumes read again within N = 6.
    set(small_time_n --dim 32 --max-n 6 --tile 64x64 --frames 2 --memory-budget 150K --json)
    # Where the regimes begin follows from bytes alone while no rule, which follows the clock, makes the volumes smaller.
    add_test(NAME bench.time_n COMMAND bench_time_n ${small_time_n} --technique ie --texture-budget 125K --dr off)
    set_tests_properties(bench.time_n PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"technique\":\"ie\".*\"points\":\\[{\"n\":1,.*\"n\":6,.*\"segments\":.*\"texture_swapping_from\":4,\"disk_reading_from\":6,.*\"n_max\":")
    add_test(NAME bench.time_n_by_slope COMMAND bench_time_n ${small_time_n} --technique ie --texture-budget 125K --dr slope)
    set_tests_properties(bench.time_n_by_slope PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"technique\":\"ie\".*\"dr\":\"slope\".*\"points\":\\[{\"n\":1,.*\"n\":6,.*\"segments\":\\[{\"level\":0,.*\"n_max\":")
    add_test(NAME bench.time_n_bad_usage COMMAND bench_time_n --texture-budget 0)
    set_tests_properties(bench.time_n_bad_usage PROPERTIES LABELS bench
        PASS_REGULAR_EXPRESSION "error: --texture-budget: .0. is no number of bytes")
    add_test(NAME bench.time_n_two_rules COMMAND bench_time_n ${small_time_n} --texture-budget 1M --dr off,slope
        --csv ${CMAKE_BINARY_DIR}/tests/bench/two.csv --svg ${CMAKE_BINARY_DIR}/tests/bench/two.svg)
    set_tests_properties(bench.time_n_two_rules PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"dr\":\"off\".*\"dr\":\"slope\".*\"summary\":.*\"n_max_without\":[1-6],\"n_max_with\":[1-6]")
    add_test(NAME bench.time_n_above_device COMMAND bench_time_n ${small_time_n} --texture-budget 900000G)
    set_tests_properties(bench.time_n_above_device PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "error: --texture-budget: .* is more than the "
        FAIL_REGULAR_EXPRESSION "wrote")
    add_test(NAME bench.time_n_small_budget COMMAND bench_time_n ${small_time_n} --texture-budget 20K)
    set_tests_properties(bench.time_n_small_budget PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "error: --texture-budget: one dataset .*does not fit"
        FAIL_REGULAR_EXPRESSION "wrote") # said before the datasets are
endif()
if(TARGET bench_arrival)
    add_test(NAME bench.arrival COMMAND bench_arrival --samples 96 --pixels 64 --frames 2 --json)
    set_tests_properties(bench.arrival PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"first_picture_ms\":.*\"arriving\":{\"frames\":.*\"arrived\":{\"frames\":2,")
endif()
if(TARGET voxsheet AND TARGET bench_time_n)
    # The texture of the clip object takes 2.1 MB.
    add_test(NAME bench.time_n_figures COMMAND voxsheet bench time-n ${small_time_n} --texture-budget 3M
        --figures ${CMAKE_BINARY_DIR}/tests/bench/figures)
    set_tests_properties(bench.time_n_figures PROPERTIES LABELS bench TIMEOUT 300 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"runs\":.*\"dr\": \"slope\".*\"n_max\".*\"n_max_without\"")
    add_test(NAME bench.time_n_figures_by_slope COMMAND voxsheet bench time-n ${small_time_n} --texture-budget 3M
        --figures ${CMAKE_BINARY_DIR}/tests/bench/figures_by_slope --dr slope)
    set_tests_properties(bench.time_n_figures_by_slope PROPERTIES LABELS bench TIMEOUT 300 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"runs\":.*\"dr\": \"slope\"" FAIL_REGULAR_EXPRESSION "\"dr\": \"off\"")
    add_test(NAME bench.time_n_figures_by_time COMMAND voxsheet bench time-n ${small_time_n}
        --figures ${CMAKE_BINARY_DIR}/tests/bench/figures_by_time --dr time)
    set_tests_properties(bench.time_n_figures_by_time PROPERTIES LABELS bench TIMEOUT 60 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "error: --dr: none of the figures 6 to 8 is drawn by time; " FAIL_REGULAR_EXPRESSION "wrote")
endif()
if(TARGET voxsheet)
    add_test(NAME bench.http COMMAND voxsheet bench http --clients 1,3 --seconds 0.1 --dim 16 --width 32 --height 32 --json)
    set_tests_properties(bench.http PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"latency_ms_p99\".*\"route\": \"image_drawn\"")
    add_test(NAME bench.edit COMMAND voxsheet bench edit --cells 4 --dim 16 --width 32 --height 32 --repeats 2 --json)
    set_tests_properties(bench.edit PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"all_ms\": .*\"dirty_ms\": .*\"ratio\": ")
    add_test(NAME bench.edit_to_pixels COMMAND voxsheet bench edit-to-pixels --cells 4 --dim 16 --width 128 --height 128 --edits 2 --json)
    set_tests_properties(bench.edit_to_pixels PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"edit\": \"camera\",.*\"final_ms_p50\": .*\"first_ms_p95\": .*\"edit\": \"formula\"")
endif()
if(TARGET voxsheet)
    add_test(NAME bench.import COMMAND voxsheet bench import --dim 24 --repeats 1 --files 1,3 --file-dim 16 --json)
    set_tests_properties(bench.import PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        PASS_REGULAR_EXPRESSION "\"format\": \"nrrd raw\".*\"plain_mb_s\".*\"format\": \"xsf\".*\"ratio\".*\"first_picture_ms\"")
endif()
if(TARGET voxsheet)
    add_test(NAME bench.calibrate COMMAND voxsheet bench calibrate --dim 24 --pixels 48 --frames 2 --json)
    set_tests_properties(bench.calibrate PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        ENVIRONMENT XDG_CACHE_HOME=${CMAKE_BINARY_DIR}/tests/bench/calibrate FIXTURES_SETUP calibration
        PASS_REGULAR_EXPRESSION "\"same_picture\": true.*\"technique\": \"raycast\".*\"chosen\": {.*\"isosurface\": {.*\"date\": ")
    add_test(NAME bench.calibrate_forget COMMAND voxsheet bench calibrate --forget --json)
    set_tests_properties(bench.calibrate_forget PROPERTIES LABELS bench TIMEOUT 120 RESOURCE_LOCK gpu
        ENVIRONMENT XDG_CACHE_HOME=${CMAKE_BINARY_DIR}/tests/bench/calibrate FIXTURES_REQUIRED calibration
        PASS_REGULAR_EXPRESSION "\"forgotten\": true")
endif()
