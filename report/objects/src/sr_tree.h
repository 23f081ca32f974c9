#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmsr/dsrdoc.h>

#include "source_images.h"
#include "vicon/report/coded_findings.h"

namespace vicon::report {

inline constexpr auto kContains = DSRTypes::RT_contains;

/// Builds the tree of a structured report from above to below. Every item is added below the container that is open.
class SrTree {
public:
    using Relation = DSRTypes::E_RelationshipType;

    explicit SrTree(DSRDocumentTree& tree) : tree_(tree) {}

    /// The root, or a container below the open one; `fill` adds what is in it. @param tid a DCMR template, or nothing
    template <class Fill>
    void container(Relation relation, const Code& concept_name, const char* tid, Fill fill)
    {
        add(relation, DSRTypes::VT_Container, concept_name);
        if (tid)
            check(item().setTemplateIdentification(tid, "DCMR"), concept_name);
        fill();
        tree_.goUp();
    }
    void text(Relation relation, const Code& concept_name, const std::string& value);
    /// Adds it only where there is something to say.
    void textWhereGiven(const Code& concept_name, const std::string& value);
    void code(Relation relation, const Code& concept_name, const Code& value);
    void person(Relation relation, const Code& concept_name, const std::string& name);
    void uid(Relation relation, const Code& concept_name, const std::string& value);
    /// The number is also kept as a double, exactly.
    void number(const Code& concept_name, double value, const Code& unit, Relation relation = DSRTypes::RT_contains);
    void numbers(const std::vector<CodedFacts::Number>& numbers);
    /// Its words and texts.
    void words(const CodedFacts& facts);
    void facts(const CodedFacts& facts)
    {
        numbers(facts.numbers);
        words(facts);
    }
    /// @param concept_name of a finding's image; none for one of the library
    void image(const Code* concept_name, const SourceImage& image);
    /// Another object that is no image.
    void object(const Code& concept_name, const std::string& sop_class, const std::string& sop_uid);
    void point(const Code& concept_name, Point3 position_mm, const std::string& frame_of_reference_uid);
    /// An open line of at least two points.
    void line(const Code& concept_name, const std::vector<Point3>& points_mm,
              const std::string& frame_of_reference_uid);

private:
    DSRContentItem& item() { return tree_.getCurrentContentItem(); }
    void add(Relation relation, DSRTypes::E_ValueType type, const std::optional<Code>& concept_name);
    static void check(const OFCondition& done, const std::optional<Code>& concept_name);
    void close(const OFCondition& done, const std::optional<Code>& concept_name);

    DSRDocumentTree& tree_;
};

}  // namespace vicon::report
