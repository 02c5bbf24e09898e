// `ao bake` by every backend and the routes that are theirs alone.
#include "tools_bake_support.hpp"

TEST_CASE("routes of the GPU backends bake the values, pictures and numbers that the CPU does", "[tools][bake]")
{
    const scratch_directory dir;
    const std::string model = dir.file("ball.obj", sphere_on_floor(3));
    const auto file = [&](const char* name) { return (dir.path / name).string(); };
    const auto baked = [&](const char* backend, const char* route) {
        bake(dir, { model, "--rule", "lebedev:302", "--backend", backend, "--route", route, "--out", file("o.npy"), "--picture",
                    file("o.png"), "--json", file("o.json") });
        const json numbers = json::parse(read_all(file("o.json")));
        CHECK(numbers["backend"] == backend);
        CHECK(numbers["route"] == route);
        CHECK(numbers["lines"] == 151);
        CHECK(numbers["settings"]["bits"] == (std::string(route) == "cube" ? "cube" : "exact"));
        CHECK(numbers["rays_per_second"].get<double>() > 0);
        return npy(file("o.npy"), "(28,)");
    };
    const std::vector<float> wanted = baked("cpu", "raster");
    const std::string picture = read_all(file("o.png"));
    const std::size_t count = files_in(dir.path);
    check_failure(dir, { "bake", model, "--route", "cube", "--out", file("never.npy") }, "the CPU does not have this route");
    CHECK(files_in(dir.path) == count);
    std::vector<const char*> backends;
#ifdef AO_HAS_GL
    backends.push_back("gl");
#endif
#ifdef AO_HAS_VK
    backends.push_back("vk");
#endif
    for (const char* backend : backends) {
        CAPTURE(backend);
        CHECK(baked(backend, "raster") == wanted);
        CHECK(read_all(file("o.png")) == picture);
        // Texels of 64 x 64 faces in place of directions: docs/numerics.md, "Per vertex".
        const std::vector<float> drawn = baked(backend, "cube");
        CHECK(read_all(file("o.png")).size() > picture.size() / 2);
        double squares = 0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const double difference = std::abs(static_cast<double>(drawn[i]) - static_cast<double>(wanted[i]));
            CHECK(difference < 0.035);
            squares += difference * difference;
        }
        const double rms = std::sqrt(squares / static_cast<double>(wanted.size()));
        CAPTURE(rms);
        CHECK(rms < 0.01);
        CHECK(rms > 0); // else no texel was ever looked at
    }
}
