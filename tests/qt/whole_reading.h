#pragma once

#include "study_walk.h"

namespace vicon::viewer::test {

/// Which study is read, on which screen, and whether from inside first or in slices first.
struct WalkOf {
    bool phantom = false;
    QSize screen;
    bool slices_first = false;
};

/// A study read from the worklist to the signature. What the reader wants is here; how the hands do it is up to those
/// who derive: each wish can be had by keyboard alone and by mouse alone.
class WholeReading : public StudyReader, public testing::WithParamInterface<WalkOf> {
protected:
    void SetUp() override;
    void TearDown() override;
    void readAll();

    // The hands.
    virtual const char* hands() const = 0;
    /// The first case of the worklist.
    virtual void openFirst() = 0;
    /// What this entry of the menus does.
    virtual void command(const QString& entry) = 0;
    /// Clicks in a view. @param by from where its cross is at first
    virtual void pick(const char* view, const std::vector<QPoint>& by) = 0;
    /// In the view that is read in.
    virtual void scroll(const char* view, int steps) = 0;
    virtual void goTo(double station_mm) = 0;
    virtual void pressButton(const char* name) = 0;
    /// A line of one of the lists beside the views.
    virtual void chooseLine(int list, const char* table, int row) = 0;
    /// An entry of a choice of the form, and a number there.
    virtual void choose(const char* choice, int entry) = 0;
    virtual void sayNumber(const char* field, int value) = 0;
    virtual void sign(QWidget* question) = 0;
    virtual void leafThrough(QWidget* pages) = 0;

    static QAction* actionOf(const QString& entry);
    static QWidget* shownDialog(const char* name);
    static bool formIsReady();

private:
    void lookAround();
    void markAndMeasure();
    void lookAtAllOfTheWall();
    void lookAsAcquired();
    void goThroughWhatWasMissed();
    void readTheOtherScan();
    void pairBoth();
    void report();
    void preview();
    /// Its picture, and that it holds together: the screen is kept to, every view has room and none is cut.
    void look(const std::string& step, std::initializer_list<const char*> views);

    const char* first() const { return GetParam().slices_first ? "axial" : "endoscopic"; }
    bool has(int count) const;
    std::filesystem::path copy_;
};

class ByKeyboard : public WholeReading {
protected:
    const char* hands() const override { return "keys"; }
    void openFirst() override;
    void command(const QString& entry) override;
    void pick(const char* view, const std::vector<QPoint>& by) override;
    void scroll(const char* view, int steps) override;
    void goTo(double station_mm) override;
    void pressButton(const char* name) override;
    void chooseLine(int list, const char* table, int row) override;
    void choose(const char* choice, int entry) override;
    void sayNumber(const char* field, int value) override;
    void sign(QWidget* question) override;
    void leafThrough(QWidget* pages) override;

private:
    static void tabTo(const char* name);
};

class ByMouse : public WholeReading {
protected:
    const char* hands() const override { return "mouse"; }
    void openFirst() override;
    void command(const QString& entry) override;
    void pick(const char* view, const std::vector<QPoint>& by) override;
    void scroll(const char* view, int steps) override;
    void goTo(double station_mm) override;
    void pressButton(const char* name) override;
    void chooseLine(int list, const char* table, int row) override;
    void choose(const char* choice, int entry) override;
    void sayNumber(const char* field, int value) override;
    void sign(QWidget* question) override;
    void leafThrough(QWidget* pages) override;

private:
    static void wheel(QWidget* over, int notches);
};

}  // namespace vicon::viewer::test
