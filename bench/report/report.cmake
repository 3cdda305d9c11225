# The report: a page with its own script and D3 inside.
set(report ${CMAKE_CURRENT_LIST_DIR})
set(scripts data.js front.js numbers.js state.js counters.js catalogue.js select.js answer.js cores.js choices.js difference.js changes.js rows.js  # what is shown
    marks.js tip.js panel.js draw.js tables.js controls.js page.js)  # the page; each behind what it imports
list(JOIN scripts "," script_list)
list(TRANSFORM scripts PREPEND ${report}/ OUTPUT_VARIABLE script_files)
set(parts ${CMAKE_CURRENT_BINARY_DIR}/report/page_parts.cpp)
add_custom_command(OUTPUT ${parts}
    COMMAND ${CMAKE_COMMAND} -D OUT=${parts} -D FOLDER=${report} -D SCRIPTS=${script_list} -P ${report}/embed.cmake
    DEPENDS ${report}/embed.cmake ${report}/page.html ${report}/page.css ${script_files} VERBATIM)
# What a run ends with: tables on the terminal and the picture of errors.
add_library(glsum_shown STATIC report/best.cpp report/curves.cpp report/discretisation_table.cpp report/front_table.cpp
    report/plot.cpp report/plot_message.cpp report/table.cpp)
target_link_libraries(glsum_shown PUBLIC glsum_sweep PRIVATE fmt::fmt glsum_warnings)
target_compile_options(glsum_shown PRIVATE ${GLSUM_COLD})
glsum_unite(glsum_shown)
target_precompile_headers(glsum_shown REUSE_FROM glsum_results)

add_library(glsum_report STATIC report/classic.cpp report/columns.cpp report/cost_plot.cpp
    report/difference.cpp report/gain_plot.cpp report/page.cpp report/report.cpp ${parts})
target_link_libraries(glsum_report PUBLIC glsum_shown PRIVATE fmt::fmt glsum_warnings)
target_compile_options(glsum_report PRIVATE ${GLSUM_COLD})
glsum_unite(glsum_report APART report/gain_plot.cpp)
target_precompile_headers(glsum_report REUSE_FROM glsum_results)
