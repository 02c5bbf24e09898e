#include "ao/result_text.hpp"

#include <cstdio>
#include <utility>

namespace ao::tools {

std::string text(double value)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

std::string text(float value)
{
    return text(static_cast<double>(value));
}

std::string size_text(extent size)
{
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

const char* method_text(method m)
{
    switch (m) {
    case method::box:
        return "box";
    case method::hemisphere:
        return "hemisphere";
    case method::halton:
        return "halton";
    case method::bitmask:
        return "bitmask";
    }
    return "unknown";
}

const char* pass_text(pass_type type)
{
    switch (type) {
    case pass_type::linearize:
        return "linearize";
    case pass_type::occlusion:
        return "occlusion";
    case pass_type::filter_rows:
        return "filter rows";
    case pass_type::filter_columns:
        return "filter columns";
    case pass_type::bitmask:
        return "bitmask";
    case pass_type::denoise_rows:
        return "denoise rows";
    case pass_type::denoise_columns:
        return "denoise columns";
    }
    return "unknown";
}

const char* depth_text(const facts& f)
{
    switch (f.depth_format) {
    case pixel_format::d32f:
        return "d32f";
    case pixel_format::d24:
        return "d24";
    case pixel_format::rgba16f:
        return "position16";
    case pixel_format::rgba32f:
        return "position32";
    default:
        return "linear";
    }
}

const char* normals_text(const facts& f)
{
    switch (f.normals) {
    case normal_source::vector:
        return "rgba16f";
    case normal_source::unorm10:
        return "rgb10a2";
    case normal_source::octahedral:
        return "octahedral";
    case normal_source::from_depth:
        return "none";
    }
    return "none";
}

const char* contribution_text(contribution_type c)
{
    return c == contribution_type::ritschel ? "ritschel" : c == contribution_type::bitmask ? "bitmask" : "fox-compton";
}

const char* density_text(sample_density d)
{
    switch (d) {
    case sample_density::hemisphere:
        return "hemisphere";
    case sample_density::disc_area:
        return "disc-area";
    case sample_density::disc_linear:
        return "disc-linear";
    case sample_density::slices:
        return "slices";
    }
    return "";
}

const char* history_text(history_format f)
{
    return f == history_format::precise ? "precise" : f == history_format::packed ? "packed" : "half-stalls";
}

const char* invalidation_text(invalidation_type i)
{
    return i == invalidation_type::none ? "none" : i == invalidation_type::smooth ? "smooth" : "clamp";
}

std::string projection_text(const projection_choice& p)
{
    std::string words = p.options.parallel ? "parallel" : "perspective";
    words += p.options.range == ao::depth_range::zero_to_one ? ",zero-to-one" : ",minus-one-to-one";
    words += p.options.reversed ? ",reversed" : "";
    words += p.infinite ? ",infinite" : "";
    words += p.options.y_down ? ",y-down" : "";
    return words;
}

std::string variant_text(const draw_variant& v)
{
    const std::pair<bool, const char*> words[] = {
        { v.alpha_map, "alpha map" }, { v.normal_map, "normal map" },     { v.cull_back, "culled" }, { v.mirrored, "mirrored" },
        { v.deforming, "deforming" }, { v.flat_normals, "flat normals" }, { v.uvs, "uvs" },          { v.frame, "frame" },
    };
    std::string text;
    for (const auto& [is, word] : words)
        if (is)
            text += (text.empty() ? "" : ", ") + std::string(word);
    return text.empty() ? "plain" : text;
}

} // namespace ao::tools
