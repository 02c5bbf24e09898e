// Host textures of a test, and the context they live in.
#pragma once

#include "ao/picture.hpp"
#include "host/gl_texture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace gl_test {

inline ao::host::gl_context& context()
{
    static auto made = ao::host::gl_context::create();
    REQUIRE(made);
    REQUIRE((*made)->make_current());
    return **made;
}

inline ao::host::gl_texture make_texture(ao::pixel_format format, int width, int height)
{
    auto made = ao::host::gl_texture::create(context(), format, { static_cast<unsigned>(width), static_cast<unsigned>(height) });
    REQUIRE(made);
    return std::move(*made);
}

inline ao::host::gl_texture upload(const ao::picture& from)
{
    auto made = make_texture(from.format, from.width, from.height);
    REQUIRE(made.upload(from.bytes));
    return made;
}

inline ao::picture download(const ao::host::gl_texture& from)
{
    ao::picture to(from.format, static_cast<int>(from.size.width), static_cast<int>(from.size.height));
    REQUIRE(from.download(to.bytes));
    return to;
}

// Pixels whose bits differ.
inline std::size_t differing(const ao::picture& a, const ao::picture& b)
{
    REQUIRE(a.bytes.size() == b.bytes.size());
    const auto size = static_cast<std::ptrdiff_t>(ao::bytes_per_pixel(a.format));
    std::size_t count = 0;
    for (auto i = a.bytes.begin(), j = b.bytes.begin(); i != a.bytes.end(); i += size, j += size) {
        count += std::equal(i, i + size, j) ? 0 : 1;
    }
    return count;
}

} // namespace gl_test
