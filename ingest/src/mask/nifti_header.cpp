#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

#include "mask/image_header.h"
#include "mask/refusal.h"
#include "mask/voxel_stream.h"

// NIfTI-1: a header of 348 bytes, see https://nifti.nimh.nih.gov/nifti-1. Its coordinates are right, anterior,
// superior.
namespace vicon::ingest {
namespace {

constexpr std::size_t kNiftiHeaderBytes = 348;
constexpr double kLeastOffset = 352;
constexpr double kMostOffset = 1e8;  // extensions hold a few kilobytes

/// The header's numbers by their place, in its own byte order.
class NiftiFields {
public:
    explicit NiftiFields(const std::array<char, kNiftiHeaderBytes>& bytes) : bytes_(bytes)
    {
        swapped_ = at<std::int32_t>(0) != std::int32_t(kNiftiHeaderBytes);
    }
    template <class Number>
    Number at(std::size_t place) const
    {
        std::array<char, sizeof(Number)> own{};
        std::copy_n(bytes_.begin() + std::ptrdiff_t(place), own.size(), own.begin());
        if (swapped_)
            std::reverse(own.begin(), own.end());
        return std::bit_cast<Number>(own);
    }
    bool swapped() const { return swapped_; }
    bool isNifti() const
    {
        return at<std::int32_t>(0) == std::int32_t(kNiftiHeaderBytes) && bytes_[344] == 'n' && bytes_[346] == '1';
    }
    bool holdsVoxels() const { return bytes_[345] == '+'; }

private:
    std::array<char, kNiftiHeaderBytes> bytes_;
    bool swapped_ = false;
};

std::optional<VoxelType> niftiType(int code)
{
    switch (code) {
        case 2:
            return VoxelType::u8;
        case 4:
            return VoxelType::i16;
        case 8:
            return VoxelType::i32;
        case 16:
            return VoxelType::f32;
        case 64:
            return VoxelType::f64;
        case 256:
            return VoxelType::i8;
        case 512:
            return VoxelType::u16;
        case 768:
            return VoxelType::u32;
        case 1024:
            return VoxelType::i64;
        case 1280:
            return VoxelType::u64;
        default:
            return std::nullopt;
    }
}

/// From right, anterior, superior; `unit_mm` is the file's unit of length.
Vector3 fromRas(double right, double anterior, double superior, double unit_mm)
{
    return {-right * unit_mm, -anterior * unit_mm, superior * unit_mm};
}

Placement byRows(const NiftiFields& header, double unit_mm)
{
    constexpr std::size_t kRows[] = {280, 296, 312};
    const auto column = [&](std::size_t n) {
        const auto at = [&](std::size_t row) { return double(header.at<float>(row + 4 * n)); };
        return fromRas(at(kRows[0]), at(kRows[1]), at(kRows[2]), unit_mm);
    };
    return {.size = {}, .first_mm = Point3{} + column(3), .step_mm = {column(0), column(1), column(2)}};
}

/// The method of quaternions.
Placement byTurn(const NiftiFields& header, double unit_mm)
{
    const auto number = [&](std::size_t place) { return double(header.at<float>(place)); };
    const double b = number(256), c = number(260), d = number(264);
    const double a = std::sqrt(std::max(0.0, 1 - (b * b + c * c + d * d)));
    const double x_mm = number(80), y_mm = number(84), z_mm = number(76) < 0 ? -number(88) : number(88);
    Placement out;
    out.first_mm = Point3{} + fromRas(number(268), number(272), number(276), unit_mm);
    out.step_mm = {fromRas(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c), unit_mm * x_mm),
                   fromRas(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b), unit_mm * y_mm),
                   fromRas(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c, unit_mm * z_mm)};
    return out;
}

/// Farthest that a corner lies from the same one, in voxels of the first.
double apart_voxels(const Placement& one, const Placement& other)
{
    double most = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        Vector3 off = one.first_mm - other.first_mm;
        for (std::size_t a = 0; a < 3; ++a)
            if (corner >> a & 1U)
                off += (one.step_mm[a] - other.step_mm[a]) * double(one.size[a] - 1);
        most = std::max(most, length(off));
    }
    return most / length(one.step_mm[0]);
}

double unit_mm(const NiftiFields& header)
{
    switch (header.at<std::uint8_t>(123) & 7U) {
        case 1:
            return 1000;
        case 3:
            return 0.001;
        default:
            return 1;
    }
}

std::array<std::int64_t, 3> sizeOf(const NiftiFields& header, const std::filesystem::path& file)
{
    const int dimensions = header.at<std::int16_t>(40);
    bool one_volume = dimensions >= 3 && dimensions <= 7;
    for (int n = 4; n <= dimensions && one_volume; ++n)
        one_volume = header.at<std::int16_t>(std::size_t(40) + 2 * std::size_t(n)) <= 1;
    if (!one_volume)
        throw maskRefused(file, "does not hold one volume of three dimensions", "write one mask in a file");
    return {header.at<std::int16_t>(42), header.at<std::int16_t>(44), header.at<std::int16_t>(46)};
}

/// A place is never guessed: a file that says none, or two, is refused.
Placement placementOf(const NiftiFields& header, const std::filesystem::path& file)
{
    const std::array<std::int64_t, 3> size = sizeOf(header, file);
    const bool has_turn = header.at<std::int16_t>(252) > 0, has_rows = header.at<std::int16_t>(254) > 0;
    if (!has_turn && !has_rows)
        throw maskRefused(file, "says no place in the patient (qform_code and sform_code are 0)",
                          "write it with the scan's affine");
    Placement rows = byRows(header, unit_mm(header)), turn = byTurn(header, unit_mm(header));
    rows.size = turn.size = size;
    constexpr double kSame_voxels = 0.5;
    if (has_turn && has_rows && !(apart_voxels(rows, turn) <= kSame_voxels))
        throw maskRefused(file, "its sform and its qform say two different places",
                          "keep the one that is the scanner's, and set the other's code to 0");
    return has_rows ? rows : turn;
}

bool isGzip(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return in.get() == 0x1f && in.get() == 0x8b;
}

}  // namespace

ImageHeader readNiftiHeader(const std::filesystem::path& file, double largest_mvoxel)
{
    ImageHeader out{.form = MaskForm::nifti, .voxel_file = file, .packed = isGzip(file)};
    std::array<char, kNiftiHeaderBytes> bytes{};
    VoxelStream(file, 0, out.packed).read(bytes.data(), bytes.size());
    const NiftiFields header(bytes);
    if (!header.isNifti() || !header.holdsVoxels())
        throw maskRefused(file, "is no NIfTI-1 file with its voxels in it", "write it as .nii or .nii.gz");
    const auto type = niftiType(header.at<std::int16_t>(70));
    if (!type)
        throw maskRefused(file, "has voxels that are no single numbers", "write it with whole numbers of 8 bits");
    const double offset = header.at<float>(108);
    if (!(offset >= kLeastOffset && offset <= kMostOffset) || offset != std::floor(offset))
        throw maskRefused(file, "its header says that voxels begin where none can", "write the mask again");
    out.grid = latticeOf(placementOf(header, file), largest_mvoxel, file);
    out.type = *type;
    out.big_endian = header.swapped();
    (out.packed ? out.skip : out.begin) = std::uint64_t(offset);
    if (const double slope = header.at<float>(112); std::isfinite(slope) && slope != 0) {
        out.slope = slope;
        out.intercept = header.at<float>(116);
    }
    return out;
}

}  // namespace vicon::ingest
