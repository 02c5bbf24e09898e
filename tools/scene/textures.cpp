#include "textures.hpp"

#include "error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ao::tools {
namespace {

constexpr int stand_in_size = 64;
constexpr int stand_in_square = 8;

const char* stand_in_words(texture_use use)
{
    switch (use) {
    case texture_use::normals:
        return "a flat one stands in";
    case texture_use::mask:
        return "white stands in";
    case texture_use::color:
        break;
    }
    return "a checkerboard stands in";
}

std::uint8_t code(double x)
{
    return static_cast<std::uint8_t>(std::lround(std::clamp(x * 127.5 + 127.5, 0.0, 255.0)));
}

} // namespace

picture stand_in(texture_use use)
{
    picture p;
    p.width = p.height = stand_in_size;
    p.rgba.reserve(std::size_t{ 4 } * stand_in_size * stand_in_size);
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const bool dark = use == texture_use::color && (x / stand_in_square + y / stand_in_square) % 2 != 0;
            const auto bright = static_cast<std::uint8_t>(dark ? 0 : 255);
            if (use == texture_use::normals)
                p.rgba.insert(p.rgba.end(), { 128, 128, 255, 255 });
            else
                p.rgba.insert(p.rgba.end(), { bright, use == texture_use::mask ? bright : std::uint8_t{ 0 }, bright, 255 });
        }
    return p;
}

bool is_grey(const picture& p)
{
    for (std::size_t i = 0; i < p.rgba.size(); i += 4)
        if (p.rgba[i] != p.rgba[i + 1] || p.rgba[i] != p.rgba[i + 2])
            return false;
    return true;
}

picture normals_of_heights(const picture& heights, float scale)
{
    picture p;
    p.width = heights.width;
    p.height = heights.height;
    p.rgba.reserve(heights.rgba.size());
    const auto height = [&](int x, int y) {
        const int column = (x + p.width) % p.width, row = (y + p.height) % p.height;
        return heights.rgba[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(p.width) +
                                 static_cast<std::size_t>(column))] /
               255.0;
    };
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const double right = static_cast<double>(scale) * (height(x + 1, y) - height(x - 1, y)) / 2.0;
            const double up = static_cast<double>(scale) * (height(x, y - 1) - height(x, y + 1)) / 2.0;
            const double length = std::sqrt(right * right + up * up + 1.0);
            p.rgba.insert(p.rgba.end(), { code(-right / length), code(-up / length), code(1.0 / length), 255 });
        }
    return p;
}

void texture_shelf::embed(const std::string& name, picture p)
{
    sources[name].p = std::move(p);
}

void texture_shelf::embed_broken(const std::string& name, const std::string& reason)
{
    sources[name].reason = reason;
}

texture_shelf::source& texture_shelf::find(const std::string& name)
{
    const auto [entry, is_new] = sources.try_emplace(name);
    source& found = entry->second;
    if (!is_new)
        return found;
    const std::filesystem::path path = find_picture(directory, name);
    if (path.empty()) {
        found.reason = "no such file";
        return found;
    }
    try {
        found.p = read_picture(path);
    } catch (const error& e) {
        found.reason = e.what();
    }
    return found;
}

int texture_shelf::put(const std::string& key, const std::string& name, const picture& p, texture_use use, wrapping wrap,
                       bool missing)
{
    const std::string full_key = key + "\n" + std::to_string(static_cast<int>(wrap.u)) + std::to_string(static_cast<int>(wrap.v));
    const auto [entry, is_new] = indices.try_emplace(full_key, static_cast<int>(s->textures.size()));
    if (is_new)
        s->textures.push_back({ one_line(name), p.width, p.height, use == texture_use::color, wrap.u, wrap.v, p.rgba, missing });
    return entry->second;
}

int texture_shelf::add(const std::string& name, texture_use use, wrapping wrap)
{
    source& found = find(name);
    if (!found.p.rgba.empty())
        return put((use == texture_use::color ? "color\n" : "data\n") + name, name, found.p, use, wrap, false);
    if (!std::exchange(found.warned, true))
        s->warnings.push_back(s->name + ": texture '" + one_line(name) + "': " + found.reason + "; " + stand_in_words(use));
    const std::string kind = "stand-in " + std::to_string(static_cast<int>(use)) + "\n";
    return put(kind + name, name, stand_in(use), use, wrap, true);
}

int texture_shelf::add_bumps(const std::string& name, float scale, wrapping wrap)
{
    const source& found = find(name);
    if (found.p.rgba.empty() || !is_grey(found.p))
        return add(name, texture_use::normals, wrap);
    return put("bumps " + std::to_string(scale) + "\n" + name, name, normals_of_heights(found.p, scale), texture_use::normals,
               wrap, false);
}

} // namespace ao::tools
