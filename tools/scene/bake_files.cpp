#include "bake_files.hpp"

#include "error.hpp"
#include "images.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace ao::tools {
namespace {

static_assert(std::endian::native == std::endian::little, "files are written as they are in memory");

template <class T>
void append(std::string& out, T value)
{
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    out.append(raw, sizeof(T));
}

template <class T>
void append_number(std::string& out, T value)
{
    char text[64];
    const auto [end, code] = std::to_chars(text, text + sizeof text, value);
    out.append(text, code == std::errc() ? end : text);
}

void append_numbers(std::string& out, char between, const glm::vec3& v)
{
    for (int i = 0; i < 3; ++i) {
        out += between;
        append_number(out, v[i]);
    }
}

// Whether floats hold all that the file said.
bool floats_suffice(const bake_model& m)
{
    return std::all_of(m.positions.begin(), m.positions.end(), [](const glm::dvec3& p) {
        for (int i = 0; i < 3; ++i)
            if (std::isfinite(p[i]) && static_cast<double>(static_cast<float>(std::clamp(p[i], -3e38, 3e38))) != p[i])
                return false;
        return true;
    });
}

std::string header_of_ply(const bake_model& m, const baked_values& v, bool doubles)
{
    const std::string coordinate = doubles ? "property double " : "property float ";
    std::string out = "ply\nformat binary_little_endian 1.0\ncomment ambient occlusion per vertex by ao\nelement vertex " +
                      std::to_string(m.positions.size()) + '\n';
    for (const char* name : { "x", "y", "z" })
        out += coordinate + name + '\n';
    const auto floats = [&](std::initializer_list<const char*> names) {
        for (const char* name : names)
            out += std::string("property float ") + name + '\n';
    };
    if (!m.normals.empty())
        floats({ "nx", "ny", "nz" });
    out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    floats({ "quality" });
    if (!v.bent.empty())
        floats({ "bent_x", "bent_y", "bent_z" });
    return out + "element face " + std::to_string(m.polygons()) + "\nproperty list uint uint vertex_indices\nend_header\n";
}

} // namespace

bake_format bake_format_of(const std::string& path)
{
    std::string suffix = std::filesystem::path(path).extension().string();
    for (char& c : suffix)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    static constexpr std::array<std::pair<std::string_view, bake_format>, 5> all{ {
        { ".ply", bake_format::ply },
        { ".glb", bake_format::glb },
        { ".obj", bake_format::obj },
        { ".npy", bake_format::npy },
        { ".csv", bake_format::csv },
    } };
    for (const auto& [name, format] : all)
        if (name == suffix)
            return format;
    throw error(path + ": the name must end in .ply, .glb, .obj, .npy or .csv");
}

std::string ply_of(const bake_model& m, const baked_values& v)
{
    const bool doubles = !floats_suffice(m);
    std::string out = header_of_ply(m, v, doubles);
    out.reserve(out.size() + m.positions.size() * 64 + m.corners.size() * 4 + m.polygons() * 4);
    std::vector<float> colors;
    for (const glm::vec3& c : v.colors)
        colors.insert(colors.end(), { c.x, c.y, c.z });
    const std::vector<std::uint8_t> bytes = to_bytes(colors);
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
        for (int k = 0; k < 3; ++k)
            doubles ? append(out, m.positions[i][k]) : append(out, static_cast<float>(m.positions[i][k]));
        if (!m.normals.empty())
            append(out, m.normals[i]);
        for (std::size_t k = 0; k < 3; ++k)
            append(out, bytes[3 * i + k]);
        append(out, v.coefficients[i]);
        if (!v.bent.empty())
            append(out, v.bent[i]);
    }
    for (std::size_t f = 0; f < m.polygons(); ++f) {
        const auto of = m.polygon(f);
        append(out, static_cast<std::uint32_t>(of.size()));
        for (const std::uint32_t c : of)
            append(out, c);
    }
    return out;
}

std::string obj_of(const bake_model& m, const baked_values& v)
{
    std::string out = "# ambient occlusion per vertex by ao: x y z red green blue\n";
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
        out += 'v';
        for (int k = 0; k < 3; ++k) {
            out += ' ';
            append_number(out, m.positions[i][k]);
        }
        append_numbers(out, ' ', v.colors[i]);
        out += '\n';
    }
    for (const glm::vec3& n : m.normals) {
        out += "vn";
        append_numbers(out, ' ', n);
        out += '\n';
    }
    for (std::size_t f = 0; f < m.polygons(); ++f) {
        if (m.object_names.size() > 1 && (f == 0 || m.object[f] != m.object[f - 1]))
            out += "o " + (m.object_names[m.object[f]].empty() ? "part" : m.object_names[m.object[f]]) + '\n';
        out += 'f';
        for (const std::uint32_t c : m.polygon(f)) {
            out += ' ';
            append_number(out, std::uint64_t{ c } + 1);
            if (!m.normals.empty()) {
                out += "//";
                append_number(out, std::uint64_t{ c } + 1);
            }
        }
        out += '\n';
    }
    return out;
}

std::string recolored_obj(std::string_view text, const baked_values& v)
{
    constexpr std::string_view blanks = " \t\r\v\f";
    std::string out;
    out.reserve(text.size() + text.size() / 2);
    std::size_t vertex = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1);
        const std::string_view line = text.substr(0, end + 1);
        text.remove_prefix(end + 1);
        std::size_t at = line.find_first_not_of(blanks);
        if (at == std::string_view::npos || line[at] != 'v' ||
            blanks.find(line[at + 1 < line.size() ? at + 1 : at]) == line.npos) {
            out += line;
            continue;
        }
        if (vertex == v.colors.size() || line.find('\\') != line.npos)
            return {};
        out += 'v';
        ++at;
        for (int k = 0; k < 3 && at < line.size(); ++k) {
            const std::size_t start = std::min(line.find_first_not_of(blanks, at), line.size());
            at = std::min(line.find_first_of(" \t\r\v\f\n", start), line.size());
            out.append(" ").append(line.substr(start, at - start));
        }
        append_numbers(out, ' ', v.colors[vertex]);
        out += '\n';
        ++vertex;
    }
    return vertex == v.colors.size() ? out : std::string();
}

std::string npy_of(const baked_values& v)
{
    const std::string rows = std::to_string(v.coefficients.size());
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + rows + (v.light.empty() ? ",), }" : ", 3), }");
    // The values begin at a multiple of 64.
    header.append(63 - (10 + header.size()) % 64, ' ');
    header += '\n';
    std::string out("\x93NUMPY\x01\x00", 8);
    append(out, static_cast<std::uint16_t>(header.size()));
    out += header;
    if (v.light.empty())
        out.append(reinterpret_cast<const char*>(v.coefficients.data()), v.coefficients.size_bytes());
    else
        out.append(reinterpret_cast<const char*>(v.light.data()), v.light.size_bytes());
    return out;
}

std::string csv_of(const baked_values& v)
{
    std::string out = "vertex,coefficient,error";
    out += v.bent.empty() ? "" : ",bent_x,bent_y,bent_z";
    out += v.light.empty() ? "\n" : ",red,green,blue\n";
    for (std::size_t i = 0; i < v.coefficients.size(); ++i) {
        append_number(out, i);
        for (const float value : { v.coefficients[i], v.errors[i] }) {
            out += ',';
            append_number(out, value);
        }
        if (!v.bent.empty())
            append_numbers(out, ',', v.bent[i]);
        if (!v.light.empty())
            append_numbers(out, ',', v.light[i]);
        out += '\n';
    }
    return out;
}

} // namespace ao::tools
