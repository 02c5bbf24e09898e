#include "ao/bake_results.hpp"

#include "ao/color.hpp"
#include "ao/outcome.hpp"
#include "scene/bake_files.hpp"
#include "scene/files.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace ao::tools {
namespace {

// Means over the copies of each vertex of the file.
template <class Value>
std::vector<Value> gathered(const std::vector<Value>& values, const bake_work& w)
{
    if (w.sources.empty() || values.empty())
        return values;
    std::vector<Value> sums(w.model.positions.size(), Value(0));
    std::vector<float> counts(sums.size(), 0.0f);
    for (std::size_t i = 0; i < w.sources.size(); ++i) {
        sums[w.sources[i]] += values[i];
        counts[w.sources[i]] += 1.0f;
    }
    for (std::size_t v = 0; v < sums.size(); ++v)
        sums[v] /= counts[v];
    return sums;
}

bool is_obj(const std::string& path)
{
    std::string suffix = std::filesystem::path(path).extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return suffix == ".obj";
}

std::string bytes_for(bake_format format, const bake_work& w, const baked_values& mesh, const baked_values& file)
{
    switch (format) {
    case bake_format::ply:
        return ply_of(w.baked(), mesh);
    case bake_format::glb:
        return glb_of(w.baked(), mesh);
    case bake_format::obj: {
        std::string same =
            is_obj(w.model.name) && w.sources.empty() ? recolored_obj(read_file(w.model.name), mesh) : std::string();
        return same.empty() ? obj_of(w.baked(), mesh) : same;
    }
    case bake_format::npy:
        return npy_of(file);
    case bake_format::csv:
        break;
    }
    return csv_of(file);
}

} // namespace

bake_results finish_work(const bake_options& o, const bake_work& work, const std::vector<bake_part>& parts)
{
    bake_results r;
    const ao::bake_sums sums = together(parts);
    for (const ao::bake_sum& s : sums.sums)
        r.rays += static_cast<std::uint64_t>(std::max(s.count, 0));
    r.baked = finish_bake(work.job, sums);
    r.coefficients = gathered(r.baked.coefficients, work);
    r.errors = gathered(r.baked.errors, work);
    r.bent = gathered(r.baked.bent, work);
    for (glm::vec3& b : r.bent)
        if (const float length = glm::length(b); length > 0.0f)
            b /= length;
    for (const float c : r.baked.coefficients)
        r.colors.emplace_back(o.remap(c));
    if (o.light.file.empty())
        return r;
    r.light = light_at(o.light, work);
    for (std::size_t v = 0; v < r.light.size(); ++v) {
        r.colors[v] *= r.light[v];
        r.light[v] *= r.baked.coefficients[v];
    }
    return r;
}

void write_results(const bake_options& o, const bake_work& work, const bake_results& r)
{
    // Light is shown as screens take it, but by glTF, which asks for linear colours.
    std::vector<glm::vec3> shown = r.colors;
    if (!r.light.empty())
        for (glm::vec3& c : shown)
            for (int k = 0; k < 3; ++k)
                c[k] = srgb_of_linear(std::clamp(c[k], 0.0f, 1.0f));
    const std::vector<glm::vec3> light = gathered(r.light, work);
    const baked_values mesh{ r.baked.coefficients, r.baked.errors, r.baked.bent, {}, shown };
    const baked_values linear{ r.baked.coefficients, r.baked.errors, r.baked.bent, {}, r.colors };
    const baked_values file{ r.coefficients, r.errors, r.bent, light, {} };
    for (const std::string& name : o.out) {
        std::string bytes;
        try {
            const bake_format format = bake_format_of(name);
            bytes = bytes_for(format, work, format == bake_format::glb ? linear : mesh, file);
        } catch (const error& e) {
            throw error(name + ": " + e.what());
        }
        write_file(name, bytes);
        stop_if_interrupted();
    }
    if (!o.picture.empty())
        write_file(o.picture, picture_of(work.baked(), shown, o.size));
}

} // namespace ao::tools
