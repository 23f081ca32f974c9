// What of a study becomes a scan, and what is kept or set aside.
#include <gtest/gtest.h>

#include "import_fixture.h"
#include "vicon/core/quantity.h"

using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

TEST_F(Import, OfTheReconstructionsOfAnAcquisitionTheThinnestSoftOneIsTheScan)
{
    SeriesSpec thick, thin_sharp, thin_soft, prone;
    thick.slices = 12;
    thin_sharp = secondSeries(thick, "2");
    thin_sharp.kernel = "B70f";
    thin_sharp.step_mm.z = 0.5;
    thin_sharp.thickness_mm = 0.5;
    thin_sharp.slices = 48;
    thin_soft = secondSeries(thin_sharp, "3");
    thin_soft.kernel = "B30f";
    thin_soft.step_mm.z = 1;
    thin_soft.thickness_mm = 1;
    thin_soft.slices = 24;
    prone = secondSeries(thick, "4");
    prone.patient_position = "HFP";
    prone.acquisition_number = "2";
    prone.acquisition_time = "102500";
    // In an order in which each import changes what is the scan.
    std::map<std::string, ScanRole> roles;
    for (const SeriesSpec& spec : {thin_sharp, thick, prone, thin_soft}) {
        writeSeries(folder / spec.series_uid, spec);
        import({folder / spec.series_uid});
    }
    for (const ScanRecord& scan : store.scans(CaseStore::caseIdFor(thick.study_uid)))
        roles[scan.series.uid] = scan.role;
    EXPECT_EQ(roles[thick.series_uid], ScanRole::kept);
    EXPECT_EQ(roles[thin_sharp.series_uid], ScanRole::kept);
    EXPECT_EQ(roles[thin_soft.series_uid], ScanRole::scan);
    EXPECT_EQ(roles[prone.series_uid], ScanRole::scan);
    EXPECT_EQ(jobs(), 2);
}

TEST_F(Import, ASecondSupineAcquisitionIsAScanOfItsOwn)
{
    SeriesSpec first, second = secondSeries(first, "2");
    second.acquisition_number = "2";
    second.acquisition_time = "101700";
    writeSeries(folder / "a", first);
    writeSeries(folder / "b", second);
    EXPECT_EQ(import({folder / "a", folder / "b"}).scans_stored, 2);
}

TEST_F(Import, WhatWasTakenWithinSecondsIsOneAcquisition)
{
    for (const auto& [time, scans] : {std::pair{"101003", 1}, std::pair{"101103", 2}, std::pair{"111003", 2}}) {
        SeriesSpec first;
        first.study_uid += std::string(".") + time;
        first.series_uid = first.study_uid + ".1";
        first.acquisition_time = "100959";
        SeriesSpec second = secondSeries(first, "2");
        second.acquisition_time = time;
        const std::filesystem::path in = folder / time;
        writeSeries(in / "a", first);
        writeSeries(in / "b", second);
        EXPECT_EQ(import({in / "a", in / "b"}).scans_stored, scans) << time;
    }
}

TEST_F(Import, FewerThanTenSlicesAreKeptAndNotQueued)
{
    SeriesSpec spec;
    spec.slices = 9;
    writeSeries(folder / "in", spec);
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.images_kept, 1);
    EXPECT_TRUE(report.anythingStored());
    EXPECT_TRUE(says(report, Kind::kept, "9 slices, fewer than the 10 of a scan")) << lines(report);
    EXPECT_EQ(onlyScan().role, ScanRole::kept);
    EXPECT_EQ(jobs(), 0);
    EXPECT_EQ(load(onlyScan()).grid.size[2], 9);
}

TEST_F(Import, LocalizersScreenSavesAndOtherModalitiesAreSetAside)
{
    SeriesSpec spec, localizer = secondSeries(spec, "2"), pet = secondSeries(spec, "3");
    localizer.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
    pet.modality = "PT";
    writeSeries(folder / "in/a", spec);
    writeSeries(folder / "in/b", localizer, {0});
    writeSeries(folder / "in/c", pet);
    SeriesSpec in_series = localizer;  // some scanners put the localizer into the scan's own series
    in_series.series_uid = spec.series_uid;
    writeSeries(folder / "in/d", in_series, {100});
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.set_aside, 14);
    EXPECT_EQ(report.refused, 0);
    EXPECT_TRUE(says(report, Kind::set_aside, "localizer"));
    EXPECT_TRUE(says(report, Kind::set_aside, "modality PT, no slice of CT or MR (12 files)"));
    EXPECT_EQ(onlyScan().ingest["set_aside"].size(), 1u);
}

SeriesSpec mrSeries()
{
    SeriesSpec spec;
    spec.modality = "MR";
    spec.mr_images = true;
    spec.image_type = "ORIGINAL\\PRIMARY\\M\\NONE";
    spec.intercept = 0;
    spec.densities = [](Point3 p) { return 300 + 2 * p.x + 3 * p.y + 5 * p.z; };
    return spec;
}

TEST_F(Import, MrIsAScanOfSignalWithOrWithoutRescale)
{
    SeriesSpec spec = mrSeries();
    writeSeries(folder / "in", spec);
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(quantityOf(onlyScan().series), Quantity::signal);
    const HuVolume read = load(onlyScan());
    EXPECT_EQ(read.at({3, 4, 5}), std::lround(spec.densities(read.grid.pointAt(Index3{3, 4, 5})))) << "as stored";
}

TEST_F(Import, ASignalInSmallStepsLosesNothing)
{
    SeriesSpec spec = mrSeries();
    spec.slope = 0.25;
    spec.densities = [](Point3 p) { return 100 + 0.25 * p.x + 0.5 * p.y + 0.75 * p.z; };
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    const HuVolume read = load(onlyScan());
    EXPECT_EQ(read.at({3, 4, 5}), std::lround(4 * spec.densities(read.grid.pointAt(Index3{3, 4, 5}))))
        << "in steps of a stored value";
}

TEST_F(Import, ASignalOver32767IsHalvedNotCutOff)
{
    SeriesSpec spec = mrSeries();
    spec.bits_stored = 16;
    spec.high_bit = 15;
    spec.densities = [](Point3 p) { return 50000 + 20 * p.x + 30 * p.y; };
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    const HuVolume read = load(onlyScan());
    EXPECT_NEAR(read.at({3, 4, 5}), spec.densities(read.grid.pointAt(Index3{3, 4, 5})) / 2, 1);
}

TEST_F(Import, AnMrImageWithoutAModalityIsNoDensity)
{
    SeriesSpec spec = mrSeries();
    spec.modality = "";
    spec.mr_images = true;
    spec.intercept = -100;
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    EXPECT_EQ(quantityOf(onlyScan().series), Quantity::signal);
}

TEST_F(Import, MapsOfMrAreRefused)
{
    SeriesSpec spec = mrSeries();
    spec.image_type = "DERIVED\\PRIMARY\\DIFFUSION\\ADC";
    writeSeries(folder / "in", spec);
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 0) << lines(report);
    EXPECT_TRUE(says(report, Kind::refused, "no MR signal")) << lines(report);
}

TEST_F(Import, EchoesOfMrAtOnePlaceAreScansOfTheirOwn)
{
    SeriesSpec first = mrSeries(), second = first;
    first.echo_time = "2.3";
    second.echo_time = "4.6";
    second.series_uid = first.series_uid;
    second.sop_suffix = ".7";
    second.densities = [](Point3 p) { return 500 + p.x; };
    writeSeries(folder / "a", first);
    writeSeries(folder / "b", second);
    const auto report = import({folder / "a", folder / "b"});
    EXPECT_EQ(report.refused, 0) << lines(report);
    EXPECT_EQ(report.scans_stored + report.images_kept, 2) << lines(report);
}

TEST_F(Import, AMissingPatientPositionIsSaidNotGuessed)
{
    SeriesSpec spec;
    spec.patient_position = "";
    writeSeries(folder / "prone HFP", spec);
    const auto report = import({folder / "prone HFP"});
    EXPECT_TRUE(says(report, Kind::repaired, "Patient Position not said")) << lines(report);
    EXPECT_EQ(onlyScan().series.patient_position, "");
}

TEST_F(Import, AnObjectOfAnotherGridBesideTheScanIsKeptApart)
{
    SeriesSpec spec, odd = spec;
    odd.columns = 20;
    writeSeries(folder / "in", spec);
    writeSeries(folder / "odd", odd, {77});
    const auto report = import({folder / "odd", folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.images_kept, 1);
    // The odd one alone would have been the series; the state is the same in this order.
    CaseStore parts(folder / "parts");
    ingest::importPaths(parts, {folder / "odd"}, options, quiet);
    ingest::importPaths(parts, {folder / "in"}, options, quiet);
    EXPECT_EQ(stateOf(parts), stateOf(store));
}

}  // namespace
