// Comparing pictures.
#pragma once

#include "ao/picture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>

namespace picture_test {

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

} // namespace picture_test
