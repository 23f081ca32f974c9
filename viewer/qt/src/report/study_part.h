#pragma once

#include <QWidget>
#include <functional>
#include <utility>
#include <vector>

#include "vicon/cases/known_study.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_texts.h"

class QCheckBox;

namespace vicon::viewer {

class FormChoice;
class FormNumber;
class FormText;

/// What the reader says of the whole study in grades, figures and words.
class StudyPart : public QWidget {
    Q_OBJECT
public:
    explicit StudyPart(QWidget* parent);

    void show(const ReadCase& read, const KnownStudy& known);
    bool unsaved() const;

signals:
    void said(const std::function<void(vicon::Assessment&)>& change);

private:
    void addTexts();
    void addGrades();
    void addFigures();

    std::vector<std::pair<FormText*, std::string Assessment::*>> texts_;
    std::vector<std::pair<FormChoice*, std::optional<Grade> Assessment::*>> grades_;
    std::vector<std::pair<FormNumber*, std::optional<double> Assessment::*>> figures_;
    std::vector<std::pair<QCheckBox*, bool Assessment::*>> ticks_;
};

/// A study without findings, as the site usually describes it: what the reader has said stays.
void fillAsNormal(Assessment& said, const ReportTexts& texts);

}  // namespace vicon::viewer
