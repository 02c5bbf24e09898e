// Every convention of projections on every backend, without preparing anew: only the camera changes.
#include "ao/conformance/reference.hpp"
#include "conformance/conventions.hpp"
#include "conformance/runners.hpp"

#include <catch2/catch.hpp>

using namespace ao;
using namespace ao::conformance;

TEST_CASE("all 32 conventions give the reference's bits on every backend")
{
    constexpr int width = 33;
    constexpr int height = 17;
    for (const auto& runner : usual_runners()) {
        for (const bool parallel : { false, true }) {
            bool prepared = false;
            for (const convention& c : all_conventions()) {
                if (c.options.parallel != parallel) {
                    continue;
                }
                facts f;
                f.width = width;
                f.height = height;
                f.depth = depth_source::hardware;
                f.depth_format = pixel_format::d32f;
                f.parallel = parallel;
                settings s;
                s.radius = 0.8F;
                camera view;
                view.projection = projection_of(c);
                INFO(runner->name() << ": " << c.name);
                if (prepared) {
                    REQUIRE(runner->set_camera(view));
                }
                else {
                    REQUIRE(runner->prepare(s, f, view));
                    prepared = true;
                }
                const surfaces seen = scene_in(c, width, height);
                const picture depth = pack_depth(seen.depth, width, height, f.depth, f.depth_format, view.projection);
                const picture normal = pack_normals(seen.normals, width, height, f.normals, f.normal_format);
                REQUIRE(runner->upload(depth, normal));
                REQUIRE(runner->frame());
                const auto got = runner->download();
                REQUIRE(got);
                const result<plan> p = make_plan(s, f, view);
                REQUIRE(p);
                CHECK(got->bytes == reference_visibility(*p, depth, normal).bytes);
            }
        }
    }
}
