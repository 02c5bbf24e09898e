// What tests of `ao bake` share. AO_PROGRAM is the program's path.
#pragma once

#include "program_run.hpp"
#include "tools_support.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

using words = std::vector<std::string>;
using nlohmann::json;

// A sphere of `rings` x 2 `rings` facets over a floor: a few hundred vertices that see each other.
inline std::string sphere_on_floor(int rings)
{
    std::ostringstream out;
    out.precision(9);
    out << "o floor\nv -2 -1.1 2\nv 2 -1.1 2\nv 2 -1.1 -2\nv -2 -1.1 -2\nf 1 2 3 4\no sphere\n";
    const int around = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int k = 0; k < around; ++k) {
            const double polar = 3.14159265358979 * i / rings, turn = 6.28318530717959 * k / around;
            const double across = i == 0 || i == rings ? 0.0 : std::sin(polar); // poles are one place
            out << "v " << across * std::cos(turn) << ' ' << std::cos(polar) << ' ' << across * std::sin(turn) << '\n';
        }
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < around; ++k) {
            const int a = 5 + i * around + k, b = 5 + i * around + (k + 1) % around;
            out << "f " << a << ' ' << b << ' ' << b + around << ' ' << a + around << '\n';
        }
    return out.str();
}

inline std::vector<std::vector<std::string>> rows_of(const std::string& csv)
{
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            rows.back().push_back(cell);
    }
    return rows;
}

// The float32 values of an npy file, checked against its header.
inline std::vector<float> npy(const std::filesystem::path& path, const std::string& shape)
{
    const std::string bytes = read_all(path);
    REQUIRE(bytes.size() > 10);
    REQUIRE(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
    std::uint16_t size = 0;
    std::memcpy(&size, bytes.data() + 8, 2);
    CHECK((10u + size) % 64 == 0);
    const std::string header = bytes.substr(10, size);
    CHECK(header.find("'descr': '<f4', 'fortran_order': False, 'shape': " + shape) != std::string::npos);
    std::vector<float> values((bytes.size() - 10 - size) / 4);
    std::memcpy(values.data(), bytes.data() + 10 + size, 4 * values.size());
    return values;
}

inline void bake(const scratch_directory& dir, words request)
{
    request.insert(request.begin(), "bake");
    INFO(::Catch::Detail::stringify(request));
    const int status = run(dir, request);
    INFO(read_all(dir.path / "err"));
    REQUIRE(status == 0);
}
