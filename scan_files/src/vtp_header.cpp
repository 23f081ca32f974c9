#include "vtp_header.h"

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

using Size = std::uint64_t;

/// What goes before the arrays' bytes, as text, and where they begin.
struct Head {
    std::string text;
    Size data_begin = 0;
};

constexpr std::string_view kData = "<AppendedData encoding=\"raw\">";

/// Nothing where a file has no such head: text without comments, entities and declarations of its own.
std::optional<Head> readHead(std::istream& in)
{
    constexpr std::size_t kLongest = 65536;
    std::string text(kLongest, '\0');
    in.read(text.data(), std::streamsize(text.size()));
    text.resize(std::size_t(in.gcount()));
    in.clear();
    const std::size_t end = text.find("<AppendedData");
    if (end == std::string::npos || text.compare(end, kData.size(), kData) != 0)
        return {};
    const std::size_t mark = text.find_first_not_of(" \n", end + kData.size());
    if (mark == std::string::npos || text[mark] != '_')
        return {};
    text.resize(end);
    const bool is_plain =
        std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
    if (!is_plain || text.find('&') != std::string::npos || text.find("<!") != std::string::npos ||
        text.find("<?", 1) != std::string::npos)
        return {};
    return Head{text + "</VTKFile>", mark + 1};
}

std::string_view attribute(vtkXMLDataElement* element, const char* name)
{
    const char* value = element->GetAttribute(name);
    return value ? value : "";
}

std::optional<Size> number(vtkXMLDataElement* element, const char* name)
{
    const std::string_view digits = attribute(element, name);
    Size value = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    constexpr Size kMost = Size(1) << 31;
    if (digits.empty() || failure != std::errc() || end != digits.data() + digits.size() || value > kMost)
        return {};
    return value;
}

bool hasOnly(vtkXMLDataElement* element, std::initializer_list<std::string_view> names)
{
    for (int n = 0; n < element->GetNumberOfAttributes(); ++n)
        if (std::find(names.begin(), names.end(), std::string_view(element->GetAttributeName(n))) == names.end())
            return false;
    return true;
}

bool isNamed(vtkXMLDataElement* element, std::string_view name)
{
    return element->GetName() && element->GetName() == name;
}

/// The bytes of one value; nothing for what is no number.
std::optional<Size> valueBytes(std::string_view type)
{
    for (const auto& [name, bytes] : {std::pair<std::string_view, Size>{"Int8", 1},
                                      {"UInt8", 1},
                                      {"Int16", 2},
                                      {"UInt16", 2},
                                      {"Int32", 4},
                                      {"UInt32", 4},
                                      {"Float32", 4},
                                      {"Int64", 8},
                                      {"UInt64", 8},
                                      {"Float64", 8}})
        if (type == name)
            return bytes;
    return {};
}

class Arrays {
public:
    Arrays(std::istream& in, Size begin, Size file_bytes) : in_(&in), begin_(begin), file_bytes_(file_bytes) {}

    /// Whether every array of a part has so many tuples, each array a name of its own.
    bool areOf(vtkXMLDataElement* part, Size tuples) const
    {
        std::set<std::string_view> names;
        for (int n = 0; n < part->GetNumberOfNestedElements(); ++n) {
            vtkXMLDataElement* array = part->GetNestedElement(n);
            if (!isArray(array) || !names.insert(attribute(array, "Name")).second)
                return false;
            const Size components =
                array->GetAttribute("NumberOfComponents") ? number(array, "NumberOfComponents").value_or(0) : 1;
            constexpr Size kMostComponents = 16;
            if (components < 1 || components > kMostComponents ||
                blockBytes(array) != tuples * components * *valueBytes(attribute(array, "type")))
                return false;
        }
        return true;
    }

    /// Whether cells have an end each, the last behind the last corner; which corners is seen when they are read.
    bool areCells(vtkXMLDataElement* part, Size count) const
    {
        if (part->GetNumberOfNestedElements() != 2)
            return false;
        vtkXMLDataElement* corners = part->GetNestedElement(0);
        vtkXMLDataElement* ends = part->GetNestedElement(1);
        for (vtkXMLDataElement* array : {corners, ends})
            if (!isArray(array) || array->GetAttribute("NumberOfComponents") ||
                (attribute(array, "type") != "Int32" && attribute(array, "type") != "Int64"))
                return false;
        return attribute(corners, "Name") == "connectivity" && attribute(ends, "Name") == "offsets" &&
               blockBytes(ends) == count * *valueBytes(attribute(ends, "type")) &&
               blockBytes(corners).value_or(1) % *valueBytes(attribute(corners, "type")) == 0 &&
               *blockBytes(corners) / *valueBytes(attribute(corners, "type")) == lastEnd(ends, count);
    }

private:
    static bool isArray(vtkXMLDataElement* array)
    {
        return isNamed(array, "DataArray") && array->GetNumberOfNestedElements() == 0 &&
               hasOnly(array, {"type", "Name", "NumberOfComponents", "format", "RangeMin", "RangeMax", "offset"}) &&
               attribute(array, "format") == "appended" && valueBytes(attribute(array, "type"));
    }

    /// The bytes behind an array, which begin with their count; nothing where the file does not hold them.
    std::optional<Size> blockBytes(vtkXMLDataElement* array) const
    {
        const auto offset = number(array, "offset");
        std::uint32_t bytes = 0;
        if (!offset || !in_->seekg(std::streamoff(begin_ + *offset)) ||
            !in_->read(reinterpret_cast<char*>(&bytes), sizeof bytes)) {
            in_->clear();
            return {};
        }
        if (begin_ + *offset + sizeof bytes + bytes > file_bytes_)
            return {};
        return bytes;
    }

    /// The last of `count` values of an array that has as many.
    Size lastEnd(vtkXMLDataElement* ends, Size count) const
    {
        if (count == 0)
            return 0;
        const Size bytes = *valueBytes(attribute(ends, "type"));
        Size value = 0;  // as they are written, the lowest byte first
        in_->seekg(std::streamoff(begin_ + *number(ends, "offset") + sizeof(std::uint32_t) + (count - 1) * bytes));
        in_->read(reinterpret_cast<char*>(&value), std::streamsize(bytes));
        return value;
    }

    std::istream* in_;
    Size begin_, file_bytes_;
};

bool isSoundPiece(vtkXMLDataElement* piece, const Arrays& arrays)
{
    if (!isNamed(piece, "Piece") ||
        !hasOnly(piece, {"NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys"}))
        return false;
    const char* const parts[] = {"PointData", "CellData", "Points", "Verts", "Lines", "Strips", "Polys"};
    if (piece->GetNumberOfNestedElements() != int(std::size(parts)))
        return false;
    for (int n = 0; n < int(std::size(parts)); ++n)
        if (!isNamed(piece->GetNestedElement(n), parts[n]) ||
            !hasOnly(piece->GetNestedElement(n), {"Normals", "Scalars"}))
            return false;
    Size cells = 0;
    for (int n = 3; n < int(std::size(parts)); ++n) {
        const auto count = number(piece, (std::string("NumberOf") + parts[n]).c_str());
        if (!count || !arrays.areCells(piece->GetNestedElement(n), *count))
            return false;
        cells += *count;
    }
    const auto points = number(piece, "NumberOfPoints");
    vtkXMLDataElement* positions = piece->GetNestedElement(2);
    return points && arrays.areOf(piece->GetNestedElement(0), *points) &&
           arrays.areOf(piece->GetNestedElement(1), cells) && positions->GetNumberOfNestedElements() == 1 &&
           attribute(positions->GetNestedElement(0), "NumberOfComponents") == "3" && arrays.areOf(positions, *points);
}

}  // namespace

bool isSoundVtp(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    const auto head = readHead(in);
    if (!head)
        return false;
    const auto root =
        vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(head->text.c_str()));
    if (!root || !isNamed(root, "VTKFile") || !hasOnly(root, {"type", "version", "byte_order", "header_type"}) ||
        attribute(root, "type") != "PolyData" || attribute(root, "byte_order") != "LittleEndian" ||
        attribute(root, "header_type") != "UInt32" || root->GetNumberOfNestedElements() != 1)
        return false;
    vtkXMLDataElement* data = root->GetNestedElement(0);
    return isNamed(data, "PolyData") && hasOnly(data, {}) && data->GetNumberOfNestedElements() == 1 &&
           isSoundPiece(data->GetNestedElement(0), Arrays(in, head->data_begin, fs::file_size(file)));
}

}  // namespace vicon::scan_files
