#include "scene_bytes.hpp"

#include "error.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

namespace ao::tools {
namespace {

struct writer {
    std::string bytes;

    template <class List>
    void list(const List& values)
    {
        static_assert(std::is_trivially_copyable_v<typename List::value_type>);
        const std::size_t count = values.size();
        bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(values[0]));
    }
    template <class Value>
    void value(const Value& v)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
    }
    template <class Each, class Value>
    void parts(const std::vector<Value>& values, const Each& each)
    {
        value(values.size());
        for (const Value& v : values)
            each(v);
    }
};

struct reader {
    const std::string& bytes;
    std::size_t at = 0;

    template <class List>
    void list(List& values)
    {
        std::size_t count = 0;
        take(&count, sizeof count);
        if (count > (bytes.size() - at) / sizeof(values[0]))
            throw error("a scene ends in the middle");
        values.resize(count);
        take(values.data(), count * sizeof(values[0]));
    }
    template <class Value>
    void value(Value& v)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        take(&v, sizeof v);
    }
    // Grows as the bytes are read, so that a wrong count runs out of bytes before it runs out of memory.
    template <class Each, class Value>
    void parts(std::vector<Value>& values, const Each& each)
    {
        std::size_t count = 0;
        value(count);
        values.clear();
        for (std::size_t i = 0; i < count; ++i)
            each(values.emplace_back());
    }
    void take(void* to, std::size_t size)
    {
        if (size > bytes.size() - at)
            throw error("a scene ends in the middle");
        if (size > 0)
            std::memcpy(to, bytes.data() + at, size);
        at += size;
    }
};

template <class Archive, class Names>
void names(Archive& a, Names& values)
{
    a.parts(values, [&](auto& name) { a.list(name); });
}

// The one list of what a scene consists of.
template <class Archive, class Scene>
void every_part(Archive& a, Scene& s)
{
    a.list(s.name);
    a.list(s.positions);
    a.list(s.normals);
    a.list(s.triangles);
    a.list(s.object);
    a.list(s.material);
    a.list(s.uvs);
    a.list(s.tangents);
    names(a, s.object_names);
    names(a, s.material_names);
    a.list(s.object_has_uvs);
    a.list(s.object_material);
    a.list(s.materials);
    a.list(s.blends);
    a.parts(s.textures, [&](auto& t) {
        a.list(t.name);
        a.value(t.width);
        a.value(t.height);
        a.value(t.srgb);
        a.value(t.wrap_u);
        a.value(t.wrap_v);
        a.list(t.rgba);
        a.value(t.missing);
    });
    names(a, s.warnings);
}

} // namespace

std::string to_bytes(const scene& s)
{
    writer w;
    every_part(w, s);
    return std::move(w.bytes);
}

scene scene_from_bytes(const std::string& bytes)
{
    reader r{ bytes };
    scene s;
    every_part(r, s);
    return s;
}

} // namespace ao::tools
