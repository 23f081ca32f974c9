#include <optional>

#include "mask/header_text.h"
#include "mask/image_header.h"
#include "mask/refusal.h"

// NRRD, see https://teem.sourceforge.net/nrrd/format.html.
namespace vicon::ingest {
namespace {

/// How a header's space becomes left, posterior, superior.
std::optional<Vector3> signsOf(const std::string& space)
{
    if (space == "left-posterior-superior" || space == "lps")
        return Vector3{1, 1, 1};
    if (space == "right-anterior-superior" || space == "ras")
        return Vector3{-1, -1, 1};
    if (space == "left-anterior-superior" || space == "las")
        return Vector3{1, -1, 1};
    return std::nullopt;
}

std::optional<VoxelType> nrrdType(const std::string& name)
{
    static const std::map<std::string, VoxelType> kTypes = {
        {"signed char", VoxelType::i8},
        {"int8", VoxelType::i8},
        {"int8_t", VoxelType::i8},
        {"uchar", VoxelType::u8},
        {"unsigned char", VoxelType::u8},
        {"uint8", VoxelType::u8},
        {"uint8_t", VoxelType::u8},
        {"short", VoxelType::i16},
        {"short int", VoxelType::i16},
        {"signed short", VoxelType::i16},
        {"signed short int", VoxelType::i16},
        {"int16", VoxelType::i16},
        {"int16_t", VoxelType::i16},
        {"ushort", VoxelType::u16},
        {"unsigned short", VoxelType::u16},
        {"unsigned short int", VoxelType::u16},
        {"uint16", VoxelType::u16},
        {"uint16_t", VoxelType::u16},
        {"int", VoxelType::i32},
        {"signed int", VoxelType::i32},
        {"int32", VoxelType::i32},
        {"int32_t", VoxelType::i32},
        {"uint", VoxelType::u32},
        {"unsigned int", VoxelType::u32},
        {"uint32", VoxelType::u32},
        {"uint32_t", VoxelType::u32},
        {"longlong", VoxelType::i64},
        {"long long", VoxelType::i64},
        {"long long int", VoxelType::i64},
        {"signed long long", VoxelType::i64},
        {"signed long long int", VoxelType::i64},
        {"int64", VoxelType::i64},
        {"int64_t", VoxelType::i64},
        {"ulonglong", VoxelType::u64},
        {"unsigned long long", VoxelType::u64},
        {"unsigned long long int", VoxelType::u64},
        {"uint64", VoxelType::u64},
        {"uint64_t", VoxelType::u64},
        {"float", VoxelType::f32},
        {"double", VoxelType::f64},
    };
    const auto found = kTypes.find(name);
    return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

class NrrdFields {
public:
    explicit NrrdFields(const std::filesystem::path& file)
        : file_(file), text_(readHeaderText(file, ":", [](const std::string& name) { return name.empty(); }))
    {
    }
    std::string value(const std::string& name, const std::string& otherwise = {}) const
    {
        const auto found = text_.fields.find(name);
        return found == text_.fields.end() ? otherwise : found->second;
    }
    std::vector<double> numbers(const std::string& name, std::size_t count) const
    {
        const auto found = numbersIn(value(name), count);
        if (!found)
            throw maskRefused(file_, "its header has no '" + name + "' of " + std::to_string(count) + " numbers",
                              "write it as an image of three dimensions with its place, one label image in a file");
        return *found;
    }
    std::uint64_t bytes() const { return text_.bytes; }

private:
    std::filesystem::path file_;
    HeaderText text_;
};

Placement placementOf(const NrrdFields& header, const std::filesystem::path& file)
{
    const std::string space = lowerCase(header.value("space"));
    const auto signs = signsOf(space);
    if (!signs)
        throw maskRefused(file, "says no place in the patient: its space is '" + shown(space) + "'",
                          "write it with space left-posterior-superior");
    const auto vectorOf = [&](const std::vector<double>& numbers, std::size_t n) {
        return Vector3{numbers[n] * signs->x, numbers[n + 1] * signs->y, numbers[n + 2] * signs->z};
    };
    const std::vector<double> steps = header.numbers("space directions", 9);
    Placement out{.size = {},
                  .first_mm = Point3{} + vectorOf(header.numbers("space origin", 3), 0),
                  .step_mm = {vectorOf(steps, 0), vectorOf(steps, 3), vectorOf(steps, 6)}};
    const std::vector<double> sizes = header.numbers("sizes", 3);
    for (std::size_t a = 0; a < 3; ++a)
        out.size[a] = sizes[a] >= 1 && sizes[a] < 1e6 ? std::int64_t(sizes[a]) : 0;
    return out;
}

/// What lies elsewhere, or begins in the middle of something, is refused.
void requireVoxelsBehindHeader(const NrrdFields& header, const std::filesystem::path& file)
{
    for (const char* name : {"data file", "datafile", "line skip", "lineskip", "byte skip", "byteskip"})
        if (!header.value(name).empty() && header.value(name) != "0")
            throw maskRefused(file, std::string("its voxels do not follow its header ('") + name + "')",
                              "write header and voxels into one .nrrd file");
}

}  // namespace

ImageHeader readNrrdHeader(const std::filesystem::path& file, double largest_mvoxel)
{
    const NrrdFields header(file);
    requireVoxelsBehindHeader(header, file);
    const auto type = nrrdType(lowerCase(header.value("type")));
    if (!type)
        throw maskRefused(file, "has voxels that are no single numbers", "write it with whole numbers of 8 bits");
    const std::string encoding = lowerCase(header.value("encoding"));
    if (encoding != "raw" && encoding != "gzip" && encoding != "gz")
        throw maskRefused(file, "is encoded as '" + shown(encoding) + "'", "write it raw or gzip");
    const std::string endian = lowerCase(header.value("endian", bytesOf(*type) == 1 ? "little" : ""));
    if (endian != "little" && endian != "big")
        throw maskRefused(file, "does not say in which order the bytes of a voxel are", "write the mask again");
    return {.form = MaskForm::nrrd,
            .grid = latticeOf(placementOf(header, file), largest_mvoxel, file),
            .type = *type,
            .big_endian = endian == "big",
            .voxel_file = file,
            .begin = header.bytes(),
            .packed = encoding != "raw"};
}

}  // namespace vicon::ingest
