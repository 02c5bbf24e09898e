#include "ao/picture_bytes.hpp"
#include "ao/temporal_render.hpp"
#include "scene/error.hpp"
#include "scene/files.hpp"
#include "scene/signals.hpp"

namespace ao::tools {

void write_pictures(const temporal_result& r, report_data data)
{
    const render_options& o = r.options;
    const std::vector<temporal_run>& runs = r.outcomes.runs;
    const auto write = [&](const std::string& name, const std::string& bytes) {
        if (interrupted())
            throw error("interrupted");
        write_file(o.out / name, bytes);
    };
    const auto show = [&](const std::string& name, int channels, const std::vector<std::uint8_t>& pixels) {
        data.pictures.push_back({ name, encode_png(o.size, channels, pixels) });
        write(name + ".png", data.pictures.back().png);
    };
    // The page holds what the first backend shows and the truth; the others are the same to the eye.
    const auto animate = [&](const std::string& name, const animation& shown, bool on_page) {
        const std::string bytes = shown.encode();
        write(name + ".apng", bytes);
        if (on_page)
            data.pictures.push_back({ name + ", animation", bytes });
    };
    for (const temporal_run& run : runs) {
        animate("temporal-" + run.label, *run.shown, &run == &runs.front());
        if (&run == &runs.front() && r.outcomes.truth_shown)
            animate("reference", *r.outcomes.truth_shown, true);
    }
    const std::vector<float> truth = r.outcomes.truth ? mean(*r.outcomes.truth) : std::vector<float>();
    for (const temporal_run& run : runs) {
        show("temporal-" + run.label, 1, to_bytes(run.visibility));
        write("temporal-" + run.label + ".exr", encode_exr(o.size, run.visibility));
    }
    if (!truth.empty()) {
        show("reference", 1, to_bytes(truth));
        write("reference.exr", encode_exr(o.size, truth));
    }
    for (const temporal_run& run : runs)
        if (!truth.empty())
            show("difference-" + run.label + "-reference", 3, difference_picture(run.visibility, truth));
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (std::size_t k = i + 1; k < runs.size(); ++k)
            show("difference-" + runs[i].label + "-" + runs[k].label, 1,
                 disagreement_picture(runs[i].visibility, runs[k].visibility));
    write("report.html", make_report(data));
}

} // namespace ao::tools
