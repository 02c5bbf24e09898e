#include "ao/chart_program.hpp"

#include "ao/chart_results.hpp"
#include "scene/error.hpp"
#include "scene/files.hpp"

#include <cstdio>

namespace ao::tools {

void chart(const chart_options& o)
{
    // What can fail at once fails before the work.
    if (!o.out.empty())
        make_directory(o.out);
    if (!o.json.empty())
        check_writable(o.json);
    (void)places_of(o);
    chart_results r;
    r.options = o;
    // What is done is kept, whatever becomes of the rest.
    const auto keep = [&] {
        if (!o.json.empty())
            write_file(o.json, json_of(r));
    };
    if (o.rounds > 0) {
        chart_single_frames(r);
        keep();
    }
    if (o.frames > 0) {
        chart_motion(r);
        keep();
    }
    if (o.vertices)
        chart_vertices(r);
    keep();
    std::fputs(table_of(r).c_str(), stdout);
    if (std::fflush(stdout) != 0)
        throw error("cannot write to the standard output");
}

} // namespace ao::tools
