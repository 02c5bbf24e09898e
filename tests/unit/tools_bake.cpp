// `ao bake` as a user meets it.
#include "scene/bake_model.hpp"
#include "scene/error.hpp"
#include "tools_bake_support.hpp"

#include <algorithm>
#include <utility>

TEST_CASE("bad requests for a bake end with one line and status 1, and leave nothing", "[tools][bake]")
{
    const scratch_directory dir;
    const std::string model = dir.file("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const std::string out = (dir.path / "o.csv").string();
    const std::string bad_rule = dir.file("bad.rule", "0 0 1 1\n0 0 2 1\n");
    const std::string no_rule = dir.file("empty.rule", "");
    const std::string empty = dir.file("empty.obj", "");
    const std::string no_faces =
        dir.file("no_faces.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                                 "y\nproperty float z\nend_header\n0 0 0\n");
    const std::string flat = dir.file("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    const std::string all_nan = dir.file("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    const std::string beyond = dir.file("beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    const std::string word = dir.file("word.obj", "v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n");
    const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string cut = dir.file("cut.ply", ply + std::string(40, '\1'));
    const std::string endless = dir.file("endless.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
    const std::string ply_beyond =
        dir.file("beyond.ply", ply + std::string(36, '\0') + std::string("\3\1\0\0\0\2\0\0\0\7\0\0\0", 13));
    const std::string huge =
        dir.file("huge.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float "
                             "y\nproperty float z\nend_header\n0 0 0\n");
    const std::string cut_gltf = dir.file("cut.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[");
    const std::string folder = (dir.path / "folder").string();
    std::filesystem::create_directory(folder);
    const std::size_t count = files_in(dir.path);
    const std::pair<words, std::string> cases[] = {
        { {}, "MODEL" },
        { { "no such.obj" }, "no such.obj: no such file" },
        { { folder }, "not a regular file" },
        { { empty }, "empty" },
        { { no_faces }, "no triangles" },
        { { flat }, "none of its 1 triangles has an area" },
        { { all_nan }, "none of its 1 triangles has an area" },
        { { beyond }, "beyond.obj: line 4: there is no vertex 9 of 3" },
        { { word }, "word.obj: line 2: three numbers" },
        { { cut }, "cut short" },
        { { endless }, "truncated" },
        { { ply_beyond }, "vertex 7 of 3" },
        { { huge }, "cut short" },
        { { cut_gltf }, "cut.gltf" },
        { { model, "--backend", "cuda" }, "--backend" },
        { { model, "--device" }, "--device" },
        { { model, "--lanes", "3" }, "--lanes" },
        { { model, "--threads", "-1" }, "--threads" },
        { { model, "--route", "fast" }, "--route" },
        { { model, "--route", "cube-maps" }, "route" },
        { { model, "--rule", "lebedev:5812" }, "5812" },
        { { model, "--rule", "lebedev:25" }, "negative" },
        { { model, "--rule", "fibonacci:0" }, "--rule: a rule of 0 points" },
        { { model, "--rule", "fibonacci:many" }, "--rule" },
        { { model, "--rule", "spiral:8" }, "spiral:8" },
        { { model, "--rule", bad_rule }, "line 2" },
        { { model, "--rule", no_rule }, "empty.rule" },
        { { model, "--rule", folder }, folder },
        { { model, "--rule", "halton-cosine:64" }, "cosine" },
        { { model, "--rule", "halton:64", "--route", "raster" }, "raster" },
        { { model, "--coefficient", "mean" }, "--coefficient" },
        { { model, "--distance", "0" }, "--distance" },
        { { model, "--distance", "nan" }, "--distance" },
        { { model, "--distance", "far" }, "--distance" },
        { { model, "--falloff", "cubic" }, "--falloff" },
        { { model, "--falloff", "linear" }, "finite distance" },
        { { model, "--sides", "back" }, "--sides" },
        { { model, "--occluders", "none" }, "--occluders" },
        { { model, "--normals", "crease:200" }, "--normals" },
        { { model, "--normals", "flat" }, "--normals" },
        { { model, "--ground", "w,0" }, "--ground" },
        { { model, "--ground", "y,inf" }, "--ground" },
        { { model, "--ground", "0,0,0,1" }, "ground" },
        { { model, "--ground", "1,2,3" }, "--ground" },
        { { model, "--seed", "-1" }, "--seed" },
        { { model, "--out", "o.stl" }, "o.stl: the name must end in" },
        { { model, "--out", out, "--out", out }, "written twice" },
        { { model, "--out", (dir.path / "none" / "o.csv").string() }, "cannot write" },
        { { model, "--json", folder }, "cannot write" },
        { { model, "--picture", "p.jpg" }, "--picture" },
        { { model, "--size", "8x8" }, "--picture" },
        { { model, "--picture", "p.png", "--size", "0x8" }, "--size" },
        { { model, "--remap", "1,0,1" }, "--remap" },
        { { model, "--remap", "0,1" }, "--remap" },
        { { model, "--remap", "0,1,0" }, "--remap" },
        { { model, "--keep-every", "-1" }, "--keep-every" },
        { { model, "--shard", "1/2" }, "--out" },
        { { model, "--shard", "3/2", "--out", out }, "--shard" },
        { { model, "--shard", "0/2", "--out", out }, "--shard" },
        { { model, "--shard", "half", "--out", out }, "--shard" },
        { { model, "--resume" }, "--resume" },
        { { "--merge", model }, "not a part of a bake" },
        { { "--merge", empty }, "not a part of a bake" },
        { { "--merge", "no such part" }, "no such part" },
        { { "--merge", model, "--rule", "lebedev:6" }, "--merge" },
        { { "--merge", model, "--route", "brute" }, "--merge" },
        { { model, "--rule", "lebedev:6", "--json", "/dev/full" }, "No space left on device" },
    };
    for (auto [arguments, reason] : cases) {
        arguments.insert(arguments.begin(), "bake");
        check_failure(dir, arguments, reason);
    }
    CHECK(files_in(dir.path) == count + 2); // and the two streams
}

TEST_CASE("values come in the file's own order, in every format", "[tools][bake]")
{
    const scratch_directory dir;
    // Vertex 0 is in no face, 1 and 4 lie in one place, the last has no finite place; a wall stands on the floor's far edge.
    const std::string text =
        "# corner\nmtllib none.mtl\nv 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 0\nvt 0.5 0.5\nv 1 1 0\nv nan 0 0\n"
        "f 2/1 4/1 3/1\nf 5 3 6 \nf 7 2 3\n";
    const std::string model = dir.file("corner.obj", text);
    const auto file = [&](const char* name) { return (dir.path / name).string(); };
    bake(dir, { model,       "--rule",      "lebedev:590", "--bent-normals", "--out",   file("o.csv"), "--out",  file("o.npy"),
                "--out",     file("o.ply"), "--out",       file("o.glb"),    "--out",   file("o.obj"), "--json", file("o.json"),
                "--picture", file("o.png"), "--size",      "40x30",          "--remap", "0,0.5,2" });
    CHECK(read_all(dir.path / "err").empty());
    const auto rows = rows_of(read_all(file("o.csv")));
    REQUIRE(rows.size() == 8);
    CHECK(rows[0] == words{ "vertex", "coefficient", "error", "bent_x", "bent_y", "bent_z" });
    const std::vector<float> values = npy(file("o.npy"), "(7,)");
    REQUIRE(values.size() == 7);
    for (std::size_t i = 0; i < 7; ++i) {
        REQUIRE(rows[i + 1].size() == 6);
        CHECK(rows[i + 1][0] == std::to_string(i));
        CHECK(std::stof(rows[i + 1][1]) == values[i]);
    }
    CHECK(values[0] == 1.0f);
    CHECK(values[6] == 1.0f);
    CHECK(values[3] > 0.5f); // away from the wall
    CHECK(values[3] < 1.0f);

    const json numbers = json::parse(read_all(file("o.json")));
    CHECK(numbers["vertices"] == 7);
    CHECK(numbers["triangles"] == 3);
    CHECK(numbers["unbaked"]["isolated"] == 1);
    CHECK(numbers["unbaked"]["not_finite"] == 1);
    CHECK(numbers["dropped_faces"]["not_finite"] == 1);
    CHECK(numbers["directions"] == 590);
    CHECK(numbers["rays"].get<int>() > 5 * 250);
    CHECK(numbers["rays"].get<int>() < 5 * 300);
    CHECK(numbers["error"]["greatest"].get<double>() >= numbers["error"]["typical"].get<double>());
    CHECK(numbers["coefficient"]["min"] == *std::min_element(values.begin(), values.end()));
    CHECK_FALSE(numbers["reason"].get<std::string>().empty());

    // The OBJ is the file with colours behind the places.
    const std::string colored = read_all(file("o.obj"));
    CHECK(colored.rfind("# corner\nmtllib none.mtl\nv 9 9 9 1 1 1\nv 0 0 0 ", 0) == 0);
    CHECK(colored.find("vt 0.5 0.5\nv 1 1 0 ") != std::string::npos);
    CHECK(colored.find("f 2/1 4/1 3/1\nf 5 3 6 \nf 7 2 3\n") != std::string::npos);

    // What was written is read again as the same mesh; the colour is pow(min(a / 0.5, 1), 2).
    using namespace ao::tools;
    const bake_model ply = load_bake_model(file("o.ply")), obj = load_bake_model(file("o.obj")),
                     glb = load_bake_model(file("o.glb"));
    CHECK(ply.polygons() == 3);
    CHECK(obj.polygons() == 3);
    CHECK(glb.polygons() == 2); // without the one that is not finite
    const bake_model source = load_bake_model(model);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(ply.positions[i] == source.positions[i]);
        CHECK(obj.positions[i] == source.positions[i]);
        CHECK(glb.positions[i] == source.positions[i]);
    }
    const std::string bytes = read_all(file("o.ply"));
    const std::size_t body = bytes.find("end_header\n") + 11, record = 12 + 3 + 4 + 12;
    for (std::size_t i = 0; i < 7; ++i) {
        float quality = 0;
        std::memcpy(&quality, bytes.data() + body + i * record + 15, 4);
        CHECK(quality == values[i]);
        const float shown = std::min(values[i] / 0.5f, 1.0f);
        CHECK(static_cast<unsigned char>(bytes[body + i * record + 12]) == Approx(255.0f * shown * shown).margin(1.0));
    }
    CHECK(read_all(file("o.glb")).rfind("glTF", 0) == 0);
    CHECK(read_all(file("o.glb")).find("COLOR_0") != std::string::npos);
    CHECK(read_all(file("o.png")).rfind("\x89PNG", 0) == 0);
    CHECK_FALSE(std::filesystem::exists(file("o.csv.part")));
}

TEST_CASE("a model is read the same from every kind of file", "[tools][bake]")
{
    using namespace ao::tools;
    const std::string header = "element vertex 4\nproperty float x\nproperty float y\nproperty uchar red\nproperty double z\n"
                               "element edge 1\nproperty int a\nproperty list uchar short b\nelement face 2\nproperty uchar "
                               "flag\nproperty list uchar int vertex_index\nend_header\n";
    const bake_model text = read_ply("ply\nformat ascii 1.0\ncomment any\n" + header +
                                     "0 0 7 0.5\n1 0 7 0\n1 1 7 1e-3\n+0 1 7 0\n3 2 5 6\n0 4 0 1 2 3\n1 3 2 1 0");
    for (const bool swapped : { false, true }) {
        std::string body;
        const auto put = [&](auto value) {
            char raw[sizeof value];
            std::memcpy(raw, &value, sizeof value);
            if (swapped)
                std::reverse(raw, raw + sizeof value);
            body.append(raw, sizeof value);
        };
        const double z[] = { 0.5, 0, 1e-3, 0 };
        const float xy[][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
        for (int i = 0; i < 4; ++i) {
            put(xy[i][0]);
            put(xy[i][1]);
            put(std::uint8_t{ 7 });
            put(z[i]);
        }
        put(3);
        put(std::uint8_t{ 2 });
        put(std::int16_t{ 5 });
        put(std::int16_t{ 6 });
        for (const auto& face : { std::vector<int>{ 0, 1, 2, 3 }, std::vector<int>{ 2, 1, 0 } }) {
            put(std::uint8_t{ 0 });
            put(static_cast<std::uint8_t>(face.size()));
            for (const int c : face)
                put(c);
        }
        const bake_model binary =
            read_ply(std::string("ply\nformat binary_") + (swapped ? "big" : "little") + "_endian 1.0\n" + header + body);
        CHECK(binary.positions == text.positions);
        CHECK(binary.corners == text.corners);
        CHECK(binary.first_corner == text.first_corner);
    }
    CHECK(text.positions[2] == glm::dvec3(1, 1, 1e-3));
    CHECK(text.polygons() == 2);

    const bake_model obj =
        read_obj("v 0 0 0\r\nv 1 0 \\\r\n 0\r\nv 1 1 0 0.5 0.5 0.5\nvn 0 0 2\nvn 0 2 0\ng a\nf 1//1 2//1 3//2\n"
                 "f -3//1 -2//2 -1//2\no b\nf 1/ 2 3\n");
    REQUIRE(obj.positions.size() == 3);
    CHECK(obj.positions[1] == glm::dvec3(1, 0, 0));
    CHECK(obj.object == std::vector<std::uint32_t>{ 0, 0, 1 });
    CHECK(obj.normals[0] == glm::vec3(0, 0, 1));
    CHECK(obj.normals[1].y == Approx(std::sqrt(0.5)));
    CHECK(obj.normals[2] == glm::vec3(0, 1, 0));
}

TEST_CASE("polygons become triangles that cover them once", "[tools][bake]")
{
    using namespace ao::tools;
    // A comb, whose fans from any corner leave it.
    bake_model m =
        read_obj("v 0 0 0\nv 5 0 0\nv 5 3 0\nv 4 1 0\nv 3 3 0\nv 2 1 0\nv 1 3 0\nv 0.5 1 0\nv 0 3 0\nf 1 2 3 4 5 6 7 8 9\n");
    for (const glm::dvec3 axis : { glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0) }) {
        bake_model turned = m;
        for (glm::dvec3& p : turned.positions)
            p = axis.z > 0 ? p : axis.x > 0 ? glm::dvec3(0, p.x, p.y) : glm::dvec3(p.y, 0, p.x);
        const bake_triangles t = triangles_of(turned);
        REQUIRE(t.indices.size() == 3 * 7);
        double area = 0;
        for (std::size_t i = 0; i < t.indices.size(); i += 3) {
            const auto cross = [&](const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.y - a.y * b.x; };
            const auto& p = m.positions;
            const double part = cross(p[t.indices[i + 1]] - p[t.indices[i]], p[t.indices[i + 2]] - p[t.indices[i]]) / 2;
            CHECK(part > 0);
            area += part;
        }
        double whole = 0;
        for (std::size_t i = 0; i < 9; ++i) {
            const auto &a = m.positions[i], &b = m.positions[(i + 1) % 9];
            whole += (a.x * b.y - a.y * b.x) / 2;
        }
        CHECK(area == Approx(whole).epsilon(1e-12));
    }
}

TEST_CASE("normals, objects, ground and fall-off do what they say", "[tools][bake]")
{
    const scratch_directory dir;
    const auto mean_of = [&](const std::string& model, words more, const char* rule = "lebedev:590") {
        const std::string numbers = (dir.path / "n.json").string();
        more.insert(more.begin(), { model, "--json", numbers, "--normals", "smooth", "--rule", rule });
        bake(dir, more);
        return json::parse(read_all(numbers));
    };
    const std::string cube =
        dir.file("cube.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 4 3 2\nf 5 6 7 8\n"
                             "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    CHECK(mean_of(cube, {})["coefficient"]["min"] == 1.0); // convex
    const std::string sharp = (dir.path / "n.json").string();
    bake(dir, { cube, "--normals", "crease:30", "--json", sharp });
    const json creased = json::parse(read_all(sharp));
    CHECK(creased["baked_vertices"] == 24);
    CHECK(creased["vertices"] == 8);
    CHECK(creased["coefficient"]["min"] == 1.0);
    // Upright faces see half of the ground beneath: a quarter of all that is, the bottom nothing.
    bake(dir, { cube, "--normals", "crease:30", "--ground", "y", "--json", sharp });
    const json grounded = json::parse(read_all(sharp));
    CHECK(grounded["coefficient"]["min"] == 0.0);
    CHECK(grounded["coefficient"]["mean"].get<double>() == Approx((0.0 + 4 * 0.5 + 1.0) / 6).margin(5e-3));
    CHECK(mean_of(cube, { "--ground", "y,-1e6", "--distance", "1" })["coefficient"]["min"] == 1.0);

    const std::string ball = dir.file("ball.obj", sphere_on_floor(6));
    const auto mean = [](const json& j) { return j["coefficient"]["mean"].get<double>(); };
    const json all = mean_of(ball, {});
    CHECK(all["objects"] == 2);
    CHECK(mean_of(ball, { "--occluders", "own" })["coefficient"]["min"] == 1.0);
    CHECK(mean(mean_of(ball, { "--occluders", "others" })) == mean(all));
    CHECK(mean(mean_of(ball, { "--distance", "0.2" })) > mean(all));
    CHECK(mean(mean_of(ball, { "--distance", "0.2", "--falloff", "linear" })) > mean(mean_of(ball, { "--distance", "0.2" })));
    for (const char* rule : { "halton:256", "marsaglia:256:7", "fibonacci:255", "halton-cosine:256" }) {
        INFO(rule);
        const json j = mean_of(ball, { "--coefficient", "cosine" }, rule);
        CHECK(j["settings"]["rule"] == rule);
        CHECK(mean(j) == Approx(mean(mean_of(ball, { "--coefficient", "cosine" }))).margin(0.06));
    }
}

TEST_CASE("light is projected onto the vertices, diffuse or glossy, times what is open", "[tools][bake]")
{
    const scratch_directory dir;
    const std::string model = dir.file("ball.obj", sphere_on_floor(6));
    const auto file = [&](const char* name) { return (dir.path / name).string(); };
    // Radiance's format, flat pixels: (1, 1/2, 1/4) everywhere is mantissas 128, 64, 32 with exponent 129.
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 4\n";
    for (int i = 0; i < 16; ++i)
        hdr += "\x80\x40\x20\x81";
    const std::string sky = dir.file("even.hdr", hdr);
    for (const words& kind : { words{}, words{ "--shininess", "20" }, words{ "--shininess", "5", "--eye", "0,9,9" } }) {
        words request{ model,         "--rule", "lebedev:110", "--light", sky,          "--out",
                       file("o.npy"), "--out",  file("o.csv"), "--out",   file("o.glb") };
        request.insert(request.end(), kind.begin(), kind.end());
        bake(dir, request);
        const auto rows = rows_of(read_all(file("o.csv")));
        REQUIRE(rows.size() > 80);
        CHECK(rows[0] == words{ "vertex", "coefficient", "error", "red", "green", "blue" });
        const std::vector<float> light =
            npy(file("o.npy"), std::string("(").append(std::to_string(rows.size() - 1)).append(", 3)"));
        for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
            const float coefficient = std::stof(rows[i + 1][1]);
            const float expected[] = { coefficient, coefficient / 2, coefficient / 4 };
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(light[3 * i + k] == Approx(expected[k]).margin(1e-4));
                CHECK(light[3 * i + k] == std::stof(rows[i + 1][3 + k]));
            }
        }
    }
    const std::pair<words, std::string> cases[] = {
        { { "--light", "none.hdr" }, "none.hdr" },
        { { "--light", model }, "ball.obj" },
        { { "--shininess", "2" }, "--shininess needs --light" },
        { { "--eye", "0,0,1" }, "--eye needs --light" },
        { { "--light", sky, "--eye", "0,0,1" }, "--eye needs --shininess" },
        { { "--light", sky, "--shininess", "-1" }, "--shininess" },
        { { "--light", sky, "--shininess", "2", "--eye", "0,0" }, "--eye" },
        { { "--light", sky, "--shard", "1/2", "--out", file("part") }, "--shard" },
    };
    for (auto [arguments, reason] : cases) {
        arguments.insert(arguments.begin(), { "bake", model, "--rule", "lebedev:6" });
        check_failure(dir, arguments, reason);
    }
}
