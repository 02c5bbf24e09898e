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
    void names(const std::vector<std::string>& values)
    {
        list(std::vector<char>(values.size()));
        for (const std::string& v : values)
            list(v);
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
    void names(std::vector<std::string>& values)
    {
        std::vector<char> count;
        list(count);
        values.resize(count.size());
        for (std::string& v : values)
            list(v);
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
    a.names(s.object_names);
    a.names(s.material_names);
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
