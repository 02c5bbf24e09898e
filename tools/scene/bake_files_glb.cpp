// Khronos Group, "glTF 2.0 specification", 2021: one buffer, one mesh, one primitive.
#include "bake_files.hpp"
#include "error.hpp"

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ao::tools {
namespace {

using json = nlohmann::ordered_json;

bool finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

struct box {
    glm::dvec3 low{ HUGE_VAL };
    glm::dvec3 high{ -HUGE_VAL };
};

box box_of(const bake_model& m)
{
    box b;
    for (const glm::dvec3& p : m.positions)
        if (finite(p)) {
            b.low = glm::min(b.low, p);
            b.high = glm::max(b.high, p);
        }
    return b;
}

// So far from the origin that floats would lose more than 2^-20 of the model, or nothing.
glm::dvec3 translation_of(const box& b)
{
    const glm::dvec3 size = b.high - b.low;
    const double largest = std::max(
        { std::abs(b.low.x), std::abs(b.low.y), std::abs(b.low.z), std::abs(b.high.x), std::abs(b.high.y), std::abs(b.high.z) });
    return largest > 16.0 * std::max({ size.x, size.y, size.z }) ? glm::dvec3(glm::vec3(b.low * 0.5 + b.high * 0.5))
                                                                 : glm::dvec3(0.0);
}

class glb_writer {
public:
    void add(const char* name, const std::vector<glm::vec3>& values)
    {
        attributes[name] = accessors.size();
        json accessor = {
            { "bufferView", views.size() }, { "componentType", 5126 }, { "count", values.size() }, { "type", "VEC3" }
        };
        if (std::strcmp(name, "POSITION") == 0) {
            glm::vec3 low = values[0], high = values[0];
            for (const glm::vec3& p : values) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            accessor["min"] = { low.x, low.y, low.z };
            accessor["max"] = { high.x, high.y, high.z };
        }
        accessors.push_back(accessor);
        add_view(values.data(), values.size() * sizeof(glm::vec3), 34962);
    }
    void add_indices(const std::vector<std::uint32_t>& indices)
    {
        primitive["indices"] = accessors.size();
        accessors.push_back(
            { { "bufferView", views.size() }, { "componentType", 5125 }, { "count", indices.size() }, { "type", "SCALAR" } });
        add_view(indices.data(), indices.size() * sizeof(std::uint32_t), 34963);
    }
    std::string file(const glm::dvec3& translation)
    {
        primitive["attributes"] = attributes;
        primitive["mode"] = 4;
        primitive["material"] = 0;
        json node = { { "mesh", 0 } };
        if (translation != glm::dvec3(0.0))
            node["translation"] = { translation.x, translation.y, translation.z };
        const json root = { { "asset", { { "version", "2.0" }, { "generator", "ao bake" } } },
                            { "scene", 0 },
                            { "scenes", { { { "nodes", { 0 } } } } },
                            { "nodes", { node } },
                            { "meshes", { { { "primitives", { primitive } } } } },
                            { "materials",
                              { { { "doubleSided", true }, { "pbrMetallicRoughness", { { "metallicFactor", 0.0 } } } } } },
                            { "accessors", accessors },
                            { "bufferViews", views },
                            { "buffers", { { { "byteLength", data.size() } } } } };
        std::string text = root.dump();
        text.append((4 - text.size() % 4) % 4, ' ');
        const std::size_t size = 12 + 8 + text.size() + 8 + data.size();
        if (size > 0xffffffffU)
            throw error("too large for binary glTF, which ends at 4 GB");
        std::string out = "glTF";
        word(out, 2);
        word(out, size);
        word(out, text.size());
        out += "JSON" + text;
        word(out, data.size());
        out.append("BIN\0", 4);
        return out += data;
    }

private:
    static void word(std::string& out, std::size_t value)
    {
        const auto w = static_cast<std::uint32_t>(value);
        char raw[4];
        std::memcpy(raw, &w, 4);
        out.append(raw, 4);
    }
    void add_view(const void* from, std::size_t size, int target)
    {
        views.push_back({ { "buffer", 0 }, { "byteOffset", data.size() }, { "byteLength", size }, { "target", target } });
        data.append(static_cast<const char*>(from), size);
    }

    json attributes = json::object(), accessors = json::array(), views = json::array(), primitive = json::object();
    std::string data;
};

} // namespace

std::string glb_of(const bake_model& m, const baked_values& v)
{
    const box b = box_of(m);
    const glm::dvec3 translation = translation_of(b);
    std::vector<glm::vec3> positions;
    positions.reserve(m.positions.size());
    for (const glm::dvec3& p : m.positions) {
        const glm::dvec3 offset =
            glm::clamp(finite(p) ? p - translation : b.low - translation, glm::dvec3(-3e38), glm::dvec3(3e38));
        positions.emplace_back(offset);
    }
    std::vector<std::uint32_t> indices;
    const bake_triangles triangles = triangles_of(m);
    for (std::size_t i = 0; i < triangles.indices.size(); i += 3) {
        const auto* const t = &triangles.indices[i];
        if (std::all_of(t, t + 3, [&](std::uint32_t c) { return finite(m.positions[c]); }))
            indices.insert(indices.end(), t, t + 3);
    }
    if (indices.empty())
        throw error("no triangle is finite");
    glb_writer w;
    w.add("POSITION", positions);
    if (!m.normals.empty()) {
        std::vector<glm::vec3> normals = m.normals;
        std::replace(normals.begin(), normals.end(), glm::vec3(0.0f), glm::vec3(0.0f, 0.0f, 1.0f)); // must be of unit length
        w.add("NORMAL", normals);
    }
    w.add("COLOR_0", { v.colors.begin(), v.colors.end() });
    w.add_indices(indices);
    return w.file(translation);
}

} // namespace ao::tools
