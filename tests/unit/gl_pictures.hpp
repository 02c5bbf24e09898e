// Host textures of a test, and the context they live in.
#pragma once

#include "ao/picture.hpp"
#include "host/gl_texture.hpp"
#include "unit/picture_test.hpp"

#include <catch2/catch.hpp>

#include <cstddef>
#include <utility>

namespace gl_test {

using picture_test::differing;

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

} // namespace gl_test
