#include "vicon/scan_files/projections_file.h"

#include <future>
#include <nlohmann/json.hpp>
#include <vector>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/geometry_json.h"
#include "vicon/core/json_text.h"
#include "vicon/picture/png_file.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

constexpr int kCompression = 3;  // of zlib's 9: the projections of the 512 x 512 x 430 phantom in half the time of 6

nlohmann::json mappingOf(const Projection& p)
{
    return {
        {"name", p.name},         {"file", p.name + ".png"}, {"width", p.width}, {"height", p.height},
        {"pixel_mm", p.pixel_mm}, {"right", p.right},        {"down", p.down},   {"first_pixel_mm", p.first_pixel_mm}};
}

Projection described(const nlohmann::json& all, const std::string& name)
{
    for (const auto& j : all.at("projections"))
        if (j.at("name") == name) {
            Projection p;
            p.name = name;
            p.width = wholeNumber(j.at("width"));
            p.height = wholeNumber(j.at("height"));
            p.pixel_mm = j.at("pixel_mm");
            p.right = j.at("right").get<Vector3>();
            p.down = j.at("down").get<Vector3>();
            p.first_pixel_mm = j.at("first_pixel_mm").get<Point3>();
            return p;
        }
    return {};
}

std::vector<std::uint8_t> readPixels(const fs::path& file, int width, int height)
{
    if (!fs::exists(file))
        throw Error(ErrorCode::not_found, "no such file", file.string(), "run 'vicon work' to make it");
    try {
        picture::Picture read = picture::readPng(file, 4);
        if (read.width == width && read.height == height)
            return std::move(read.pixels);
    } catch (const Error&) {
    }
    throw Error(ErrorCode::bad_input, "is damaged, or not the picture that its description speaks of", file.string(),
                "run 'vicon work' to make it anew");
}

}  // namespace

void writeProjections(const fs::path& folder, std::span<const Projection> projections)
{
    makePrivateFolder(folder);
    nlohmann::json mapping = {{"projections", nlohmann::json::array()}};
    std::vector<std::future<void>> pictures;  // packing keeps a core busy
    for (const Projection& p : projections) {
        const nlohmann::json one = mappingOf(p);
        pictures.push_back(std::async(std::launch::async, [&folder, &p, text = one.dump()] {
            picture::writePng(folder / (p.name + ".png"), p.width, p.height, p.rgba,
                              {.compression = kCompression, .keyword = "vicon:mapping", .text = text});
        }));
        mapping["projections"].push_back(one);
    }
    for (auto& picture : pictures)
        picture.get();
    replaceFile(folder / "projections.json", mapping.dump(1) + "\n");
}

Projection readProjection(const fs::path& folder, const std::string& name)
{
    const fs::path file = folder / "projections.json";
    Projection projection;
    try {
        projection = described(parsedJson(readFile(file)), name);
    } catch (const nlohmann::json::exception&) {
    }
    if (projection.width <= 0 || projection.height <= 0 || !(projection.pixel_mm > 0))
        throw Error(ErrorCode::bad_input, "does not describe the " + name + " projection", file.string(),
                    "run 'vicon work' to make it anew");
    projection.rgba = readPixels(folder / (name + ".png"), projection.width, projection.height);
    return projection;
}

}  // namespace vicon::scan_files
