#pragma once

#include <string>

namespace vicon {

/// What a site usually writes of a study without findings; the form fills its empty fields with it when asked to.
struct ReportTexts {
    std::string indication, technique, comparison, impression, recommendation;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("report.normal_indication", indication, "", "Of a study without findings: why it was made.");
        v("report.normal_technique", technique, "", "Of a study without findings: how it was made.");
        v("report.normal_comparison", comparison, "", "Of a study without findings: earlier studies.");
        v("report.normal_impression", impression, "",
          "Of a study without findings: the impression; empty: the one that follows from the category.");
        v("report.normal_recommendation", recommendation, "",
          "Of a study without findings: the recommendation; empty: the usual one of the category.");
    }
};

}  // namespace vicon
