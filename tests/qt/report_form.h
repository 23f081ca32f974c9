#pragma once

#include <gmock/gmock.h>
#include <soci/soci.h>

#include <QComboBox>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>

#include "reading.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/report_versions.h"
#include "vicon/cases/step_results.h"

namespace vicon::viewer::test {

/// A reader at the report's form beside the views.
class Form : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        findColons();
        openCase();
    }
    /// In both scans, as the pipeline does.
    void findColons() const { recordStep("segment", {{"verdict", "colon"}, {"confidence", 1}}); }
    void openForm()
    {
        key(Qt::Key_R, Qt::ControlModifier);
        ASSERT_TRUE(eventually([&] { return form()->isVisible() && state().startsWith("Report:") && ready(); }));
        ASSERT_TRUE(eventually([] { return the<QComboBox>("distension-rectum-supine")->isVisible(); }));
    }
    static QWidget* form() { return the<QWidget>("reportForm"); }
    static QString state() { return the<QLabel>("reportState")->text(); }
    static bool ready() { return the<QPushButton>("reportPreview")->isEnabled(); }
    /// To what has the keyboard.
    static void type(int which, Qt::KeyboardModifiers modifiers = {})
    {
        strokes_ += modifiers == Qt::NoModifier ? 1 : 2;
        QTest::keyClick(QApplication::focusWidget(), Qt::Key(which), modifiers);
    }
    static void write(const QString& words)
    {
        strokes_ += int(words.size());
        QTest::keyClicks(QApplication::focusWidget(), words);
    }
    static void tabTo(const char* name)
    {
        constexpr int kMost = 120;
        std::string way;
        for (int n = 0; n < kMost && QApplication::focusWidget()->objectName() != name; ++n) {
            type(Qt::Key_Tab);
            way += QApplication::focusWidget()->objectName().toStdString() + " ";
        }
        ASSERT_EQ(QApplication::focusWidget()->objectName().toStdString(), name) << way;
    }
    static void choose(const char* combo, int down)
    {
        ASSERT_NO_FATAL_FAILURE(tabTo(combo));
        for (int n = 0; n < down; ++n)
            type(Qt::Key_Down);
    }
    template <class T>
    static bool dialog(const char* name, T** found)
    {
        return eventually([&] {
            for (QWidget* widget : QApplication::topLevelWidgets())
                for (T* one : widget->findChildren<T*>(name) + QList<T*>{qobject_cast<T*>(widget)})
                    if (one && one->objectName() == name && one->isVisible())
                        *found = one;
            return *found != nullptr;
        });
    }
    Assessment said() { return assessmentOf(*store(), kCase); }
    std::vector<Finding> found() { return findings(*store(), kCase); }
    std::unique_ptr<CaseStore> store() const { return std::make_unique<CaseStore>(store_); }
    void sign()
    {
        type(Qt::Key_G, Qt::AltModifier);
        QMessageBox* box = nullptr;
        ASSERT_TRUE(dialog("confirmSigning", &box));
        screenshot("form-confirm");
        question_ = box->text().toStdString();
        ++strokes_;
        QTest::keyClick(box, Qt::Key_Return);
        window()->activateWindow();
        ASSERT_TRUE(eventually([&] { return state().contains("signed") && ready(); }))
            << state().toStdString() << warning();
    }
    /// Both scans are well distended, as the pipeline measured.
    void measureQuality() const
    {
        ScanQuality good;
        good.whole = {.median_radius_mm = 18, .volume_ml = 1900, .adequate = true};
        good.parts.assign(1, good.whole);
        good.parts[0].part = ColonPart::transverse;
        const QualityFound found{.parts = {{ColonPart::transverse, 0, length()}}, .parts_unknown = {}, .quality = good};
        recordStep("quality", toJson(found));
    }
    void recordStep(const std::string& step, const nlohmann::json& found) const
    {
        const std::string result = found.dump();
        store()->database().write([&](soci::session& sql) {
            for (const std::string scan : {kSupine, kProne})
                sql << "INSERT INTO steps (case_id, scan_id, step, version, digest, parameters, result, seconds,"
                       " finished) VALUES ('c1', :scan, :step, 1, 'd', '{}', :result, 1, '')",
                    soci::use(scan), soci::use(step), soci::use(result);
        });
    }
    static inline int strokes_ = 0;       ///< of a person at the keyboard
    static inline std::string question_;  ///< before a signature

    /// A study without findings, said by keyboard alone.
    void sayNormal()
    {
        ASSERT_NO_FATAL_FAILURE(choose("distension-rectum-supine", 1));
        ASSERT_TRUE(eventually([&] { return the<QPushButton>("reportNormal")->isEnabled(); }));
        type(Qt::Key_L, Qt::AltModifier);
        ASSERT_TRUE(eventually([&] { return the<QPushButton>("reportSign")->isEnabled(); }));
    }
};

}  // namespace vicon::viewer::test
