#include "ao/color.hpp"
#include "ao/picture_bytes.hpp"
#include "ao/result_files.hpp"
#include "scene/error.hpp"
#include "scene/files.hpp"
#include "scene/signals.hpp"

#include <algorithm>
#include <cmath>

namespace ao::tools {
namespace {

// Near is bright.
std::vector<std::uint8_t> depth_picture(const shown_surfaces& s)
{
    const float far = *std::max_element(s.depth.begin(), s.depth.end());
    std::vector<float> gray;
    gray.reserve(s.depth.size());
    for (const float d : s.depth)
        gray.push_back(d > 0.0f ? 1.0f - 0.9f * std::sqrt(d / far) : 0.0f);
    return to_bytes(gray);
}

// Components -1 to 1 as 0 to 1; black where there is no surface.
std::vector<std::uint8_t> bent_picture(const std::vector<float>& directions, const std::vector<std::uint8_t>& hit)
{
    std::vector<float> rgb;
    rgb.reserve(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i)
        rgb.push_back(hit[i / 3] != 0 ? 0.5f + 0.5f * directions[i] : 0.0f);
    return to_bytes(rgb);
}

std::vector<std::uint8_t> normal_picture(const shown_surfaces& s)
{
    std::vector<float> rgb;
    rgb.reserve(3 * s.normal.size());
    for (std::size_t i = 0; i < s.normal.size(); ++i)
        for (int c = 0; c < 3; ++c)
            rgb.push_back(s.hit[i] != 0 ? 0.5f + 0.5f * s.normal[i][c] : 0.0f);
    return to_bytes(rgb);
}

// Linear light as it is, exposure 1: what is above 1 becomes 1. No tone mapping.
std::vector<std::uint8_t> shaded_picture(const ao::picture& color)
{
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * color.pixels());
    for (std::size_t i = 0; i < color.pixels(); ++i) {
        const auto texel = color.texel<glm::vec4>(i);
        for (int c = 0; c < 3; ++c)
            rgb.push_back(display_code(texel[c]));
    }
    return rgb;
}

} // namespace

void write_pictures(const render_result& r, report_data data)
{
    const render_options& o = r.options;
    const auto write = [&](const std::string& name, const std::string& bytes) {
        if (interrupted())
            throw error("interrupted");
        write_file(o.out / name, bytes);
    };
    const auto show = [&](const std::string& name, int channels, const std::vector<std::uint8_t>& pixels, bool file) {
        data.pictures.push_back({ name, encode_png(o.size, channels, pixels) });
        if (file)
            write(name + ".png", data.pictures.back().png);
    };

    const shown_surfaces& first = r.surfaces.front();
    std::vector<float> view_z;
    view_z.reserve(first.depth.size());
    for (const float d : first.depth)
        view_z.push_back(-d);
    write("depth.exr", encode_exr(o.size, view_z));
    if (!first.normal.empty())
        write("normal.exr", encode_exr(o.size, first.normal, "XYZ"));

    for (const scene_outcome& each : r.outcomes.scenes) {
        if (!r.shading)
            break;
        show("shaded-" + each.label, 3, shaded_picture(each.color), true);
        show("shaded-" + each.label + "-plain", 3, shaded_picture(each.plain), true);
    }
    const std::vector<run_outcome>& runs = r.outcomes.runs;
    const std::vector<float> truth = r.truth ? mean(*r.truth) : std::vector<float>();
    for (const run_outcome& run : runs) {
        show("visibility-" + run.label, 1, to_bytes(run.visibility), true);
        write("visibility-" + run.label + ".exr", encode_exr(o.size, run.visibility));
        if (!run.bent_normal.empty())
            show("bent-normal-" + run.label, 3, bent_picture(run.bent_normal, r.surfaces[run.scene].hit), true);
        if (&run == &runs.front() && r.truth) {
            show("reference", 1, to_bytes(truth), true);
            write("reference.exr", encode_exr(o.size, truth));
        }
    }
    for (const run_outcome& run : runs)
        if (r.truth)
            show("difference-" + run.label + "-reference", 3, difference_picture(run.visibility, truth), true);
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (std::size_t k = i + 1; k < runs.size(); ++k)
            show("difference-" + runs[i].label + "-" + runs[k].label, 1,
                 disagreement_picture(runs[i].visibility, runs[k].visibility), true);
    show("depth", 1, depth_picture(first), false);
    if (!first.normal.empty())
        show("normal", 3, normal_picture(first), false);
    write("report.html", make_report(data));
}

} // namespace ao::tools
