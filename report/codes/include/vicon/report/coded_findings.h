#pragma once

#include <string>
#include <vector>

#include "vicon/cases/report_content.h"
#include "vicon/report/codes.h"

namespace vicon::report {

/// What is said of one thing, in codes: each as its concept and its value. In the order of the report.
struct CodedFacts {
    struct Number {
        Code name;
        double value = 0;
        Code unit;
    };
    struct Word {
        Code name, value;
    };
    struct Text {
        Code name;
        std::string text;
    };
    std::vector<Number> numbers;
    std::vector<Word> words;
    std::vector<Text> texts;
};

/// Of a finding as a whole: the size that counts, how far an endoscope may have to go, what the reader said of it.
CodedFacts factsOfWhole(const FindingWithFacts& finding);
/// Of a finding as one marker shows it: where along the colon, its sizes there, its density.
CodedFacts factsOfSight(const FindingSight& sight);
/// Of a finding beside one of an earlier report: name, size and date of that one, and what became of it.
CodedFacts factsOfComparison(const ComparedFinding& compared);
/// What the reader chose for the whole study: categories, preparation, limits, dose and time.
CodedFacts factsOfStudy(const Assessment& said);

/// Comparison with an earlier report.
Code comparisonConcept();
/// The comparisons of a finding that the reader confirmed.
std::vector<ComparedFinding> confirmedComparisons(const ReadCase& read, const Finding& finding);

/// "Finding 7", by which a finding is known in every form.
std::string trackingName(const Finding& finding);
/// The UID by which it is known in every form, also in later versions.
std::string trackingUid(const ReadCase& read, const Finding& finding);

}  // namespace vicon::report
