#include <optional>

#include "mask/header_text.h"
#include "mask/image_header.h"
#include "mask/refusal.h"

// MetaImage, see https://itk.org/Wiki/MetaIO. MetaIO itself trusts a header; it sees none of a stranger's.
namespace vicon::ingest {
namespace {

constexpr const char* kWithPlace = "write it as an image of three dimensions with its place";

std::optional<VoxelType> metaType(const std::string& name)
{
    static const std::map<std::string, VoxelType> kTypes = {
        {"MET_CHAR", VoxelType::i8},       {"MET_UCHAR", VoxelType::u8},       {"MET_SHORT", VoxelType::i16},
        {"MET_USHORT", VoxelType::u16},    {"MET_INT", VoxelType::i32},        {"MET_UINT", VoxelType::u32},
        {"MET_LONG_LONG", VoxelType::i64}, {"MET_ULONG_LONG", VoxelType::u64}, {"MET_FLOAT", VoxelType::f32},
        {"MET_DOUBLE", VoxelType::f64},
    };
    const auto found = kTypes.find(name);
    return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

class MetaFields {
public:
    explicit MetaFields(const std::filesystem::path& file)
        : file_(file),
          text_(readHeaderText(file, "=", [](const std::string& name) { return name == "elementdatafile"; }))
    {
    }
    std::string value(std::initializer_list<const char*> names, const std::string& otherwise = {}) const
    {
        for (const char* name : names)
            if (const auto found = text_.fields.find(name); found != text_.fields.end())
                return found->second;
        return otherwise;
    }
    bool isTrue(std::initializer_list<const char*> names) const { return lowerCase(value(names, "false")) == "true"; }
    std::vector<double> numbers(std::initializer_list<const char*> names, std::size_t count) const
    {
        const auto found = numbersIn(value(names), count);
        if (!found)
            throw maskRefused(
                file_,
                std::string("its header has no '") + *names.begin() + "' of " + std::to_string(count) + " numbers",
                kWithPlace);
        return *found;
    }
    std::uint64_t bytes() const { return text_.bytes; }

private:
    std::filesystem::path file_;
    HeaderText text_;
};

Placement placementOf(const MetaFields& header)
{
    const std::vector<double> first = header.numbers({"offset", "origin", "position"}, 3);
    const std::vector<double> spacing = header.numbers({"elementspacing", "elementsize"}, 3);
    const std::vector<double> axes = header.numbers({"transformmatrix", "rotation", "orientation"}, 9);
    const std::vector<double> sizes = header.numbers({"dimsize"}, 3);
    Placement out{.size = {}, .first_mm = {first[0], first[1], first[2]}, .step_mm = {}};
    for (std::size_t a = 0; a < 3; ++a) {
        out.size[a] = sizes[a] >= 1 && sizes[a] < 1e6 ? std::int64_t(sizes[a]) : 0;
        out.step_mm[a] = Vector3{axes[3 * a], axes[3 * a + 1], axes[3 * a + 2]} * spacing[a];
    }
    return out;
}

/// A name in the header's folder: no file elsewhere is opened because a header says so.
std::filesystem::path voxelFile(const std::string& name, const std::filesystem::path& header)
{
    if (name == "LOCAL")
        return header;
    const bool plain = !name.empty() && name != "LIST" && name.find_first_of("/\\% ") == std::string::npos &&
                       name != "." && name != "..";
    std::filesystem::path file = header.parent_path() / name;
    std::error_code failure;
    if (!plain || !std::filesystem::is_regular_file(file, failure))
        throw maskRefused(header, "its voxels are not in a file beside it that it names plainly",
                          "write header and voxels into one .mha file");
    return file;
}

}  // namespace

ImageHeader readMetaImageHeader(const std::filesystem::path& file, double largest_mvoxel)
{
    const MetaFields header(file);
    if (header.value({"ndims"}) != "3" || header.value({"elementnumberofchannels"}, "1") != "1")
        throw maskRefused(file, "does not hold one volume of three dimensions", kWithPlace);
    const auto type = metaType(header.value({"elementtype"}));
    if (!type || lowerCase(header.value({"binarydata"}, "true")) != "true" || header.value({"headersize"}, "0") != "0")
        throw maskRefused(file, "has voxels that are no binary single numbers right behind the header",
                          "write it with whole numbers of 8 bits");
    const std::filesystem::path voxels = voxelFile(header.value({"elementdatafile"}), file);
    return {.form = MaskForm::meta_image,
            .grid = latticeOf(placementOf(header), largest_mvoxel, file),
            .type = *type,
            .big_endian = header.isTrue({"binarydatabyteordermsb", "elementbyteordermsb"}),
            .voxel_file = voxels,
            .begin = voxels == file ? header.bytes() : 0,
            .packed = header.isTrue({"compresseddata"})};
}

}  // namespace vicon::ingest
