#include "sr_tree.h"

#include "object_writing.h"
#include "vicon/core/error.h"
#include "vicon/dicom/proper_values.h"

namespace vicon::report {
namespace {

DSRCodedEntryValue entry(const Code& code)
{
    return {code.value.c_str(), code.scheme.c_str(), code.meaning.c_str()};
}

}  // namespace

void SrTree::check(const OFCondition& done, const std::optional<Code>& concept_name)
{
    if (done.bad())
        throw Error(ErrorCode::internal, std::string("the structured report cannot be written (") + done.text() + ")",
                    concept_name ? concept_name->meaning : "");
}

void SrTree::add(Relation relation, DSRTypes::E_ValueType type, const std::optional<Code>& concept_name)
{
    if (tree_.addContentItem(relation, type, DSRTypes::AM_belowCurrent) == 0)
        check(SR_EC_CannotAddContentItem, concept_name);
    if (concept_name)
        check(item().setConceptName(entry(*concept_name)), concept_name);
}

void SrTree::close(const OFCondition& done, const std::optional<Code>& concept_name)
{
    check(done, concept_name);
    tree_.goUp();
}

void SrTree::text(Relation relation, const Code& concept_name, const std::string& value)
{
    add(relation, DSRTypes::VT_Text, concept_name);
    close(item().setStringValue(value.c_str()), concept_name);
}

void SrTree::textWhereGiven(const Code& concept_name, const std::string& value)
{
    if (!value.empty())
        text(DSRTypes::RT_contains, concept_name, value);
}

void SrTree::code(Relation relation, const Code& concept_name, const Code& value)
{
    add(relation, DSRTypes::VT_Code, concept_name);
    close(item().setCodeValue(entry(value)), concept_name);
}

void SrTree::person(Relation relation, const Code& concept_name, const std::string& name)
{
    add(relation, DSRTypes::VT_PName, concept_name);
    close(item().setStringValue(properPersonName(name).c_str()), concept_name);
}

void SrTree::uid(Relation relation, const Code& concept_name, const std::string& value)
{
    add(relation, DSRTypes::VT_UIDRef, concept_name);
    close(item().setStringValue(properUid(value).c_str()), concept_name);
}

void SrTree::number(const Code& concept_name, double value, const Code& unit, Relation relation)
{
    add(relation, DSRTypes::VT_Num, concept_name);
    DSRNumericMeasurementValue measured(decimalString(value).c_str(), entry(unit));
    check(measured.setFloatingPointRepresentation(value), concept_name);
    close(item().setNumericValue(measured), concept_name);
}

void SrTree::numbers(const std::vector<CodedFacts::Number>& numbers)
{
    for (const auto& [name, value, unit] : numbers)
        number(name, value, unit);
}

void SrTree::words(const CodedFacts& facts)
{
    for (const auto& [name, value] : facts.words)
        code(DSRTypes::RT_contains, name, value);
    for (const auto& [name, said] : facts.texts)
        text(DSRTypes::RT_contains, name, said);
}

void SrTree::image(const Code* concept_name, const SourceImage& image)
{
    const auto name = concept_name ? std::optional(*concept_name) : std::nullopt;
    add(DSRTypes::RT_contains, DSRTypes::VT_Image, name);
    close(item().setImageReference(DSRImageReferenceValue(image.sop_class.c_str(), image.sop_uid.c_str())), name);
}

void SrTree::object(const Code& concept_name, const std::string& sop_class, const std::string& sop_uid)
{
    add(DSRTypes::RT_contains, DSRTypes::VT_Composite, concept_name);
    close(item().setCompositeReference(DSRCompositeReferenceValue(sop_class.c_str(), sop_uid.c_str())), concept_name);
}

void SrTree::point(const Code& concept_name, Point3 position_mm, const std::string& frame_of_reference_uid)
{
    add(DSRTypes::RT_contains, DSRTypes::VT_SCoord3D, concept_name);
    DSRSpatialCoordinates3DValue point(DSRTypes::GT3_Point);
    point.getGraphicDataList().addItem(Float32(position_mm.x), Float32(position_mm.y), Float32(position_mm.z));
    check(point.setFrameOfReferenceUID(properUid(frame_of_reference_uid).c_str()), concept_name);
    close(item().setSpatialCoordinates3D(point), concept_name);
}

void SrTree::line(const Code& concept_name, const std::vector<Point3>& points_mm,
                  const std::string& frame_of_reference_uid)
{
    add(DSRTypes::RT_contains, DSRTypes::VT_SCoord3D, concept_name);
    DSRSpatialCoordinates3DValue line(DSRTypes::GT3_Polyline);
    for (const Point3& p : points_mm)
        line.getGraphicDataList().addItem(Float32(p.x), Float32(p.y), Float32(p.z));
    check(line.setFrameOfReferenceUID(properUid(frame_of_reference_uid).c_str()), concept_name);
    close(item().setSpatialCoordinates3D(line), concept_name);
}

}  // namespace vicon::report
