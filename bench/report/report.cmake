# The report: a page with its own script and D3 inside. D3 comes from Debian 12's package node-d3, 5.16.0-10.
find_file(GLSUM_D3 d3.min.js PATHS /usr/share/nodejs/d3/dist NO_DEFAULT_PATH)
if(NOT GLSUM_D3)
    message(FATAL_ERROR "d3.min.js: not found below /usr/share/nodejs/d3/dist (Debian package node-d3)")
endif()
file(STRINGS ${GLSUM_D3} d3_head LIMIT_COUNT 1)
string(REGEX MATCH "v(5\\.16\\.[0-9]+) " _ "${d3_head}")
if(NOT CMAKE_MATCH_1)
    message(FATAL_ERROR "${GLSUM_D3}: expected D3 5.16, as in Debian 12, found ${d3_head}")
endif()
set(d3_version ${CMAKE_MATCH_1})

set(report ${CMAKE_CURRENT_LIST_DIR})
set(scripts data.js front.js marks.js panel.js tables.js page.js)  # one after the other, one script
list(JOIN scripts "," script_list)
list(TRANSFORM scripts PREPEND ${report}/ OUTPUT_VARIABLE script_files)
set(parts ${CMAKE_CURRENT_BINARY_DIR}/report/page_parts.cpp)
add_custom_command(OUTPUT ${parts}
    COMMAND ${CMAKE_COMMAND} -D OUT=${parts} -D FOLDER=${report} -D SCRIPTS=${script_list}
        -D D3=${GLSUM_D3} -D D3_VERSION=${d3_version} -P ${report}/embed.cmake
    DEPENDS ${report}/embed.cmake ${report}/page.html ${report}/page.css ${script_files} ${GLSUM_D3} VERBATIM)
target_sources(glsum_bench PRIVATE report/best.cpp report/classic.cpp report/columns.cpp report/cost_plot.cpp
    report/curves.cpp report/difference.cpp report/front.cpp report/gain_plot.cpp report/page.cpp report/report.cpp ${parts})
