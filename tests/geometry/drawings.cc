#include <nmm/geometry/dxf.h>

#include "test_helpers.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace NMM;
using namespace geometry_test;

namespace
{
  std::string
  write_file(const std::string &name, const std::string &text)
  {
    const std::string file =
      (std::filesystem::temp_directory_path() / name).string();
    std::ofstream(file) << text;
    return file;
  }


  /// A drawing with these entities, and records before them; two lines a pair of code and value.
  std::string
  write_drawing(const std::string &name,
                const std::string &entities,
                const std::string &before = "")
  {
    return write_file(name,
                      before + "0\nSECTION\n2\nENTITIES\n" + entities +
                        "0\nENDSEC\n0\nEOF\n");
  }


  std::string
  header(const std::string &variables)
  {
    return "0\nSECTION\n2\nHEADER\n" + variables + "0\nENDSEC\n";
  }


  const std::string line = "0\nLINE\n8\nJ1\n10\n0\n20\n0\n11\n4\n21\n3\n";


  Drawing
  read(const std::string &entities, const std::vector<std::string> &layers = {})
  {
    return read_dxf(write_drawing("drawing.dxf", entities), layers);
  }


  TEST(Drawing, EntitiesAndLayers)
  {
    const std::string file = write_drawing(
      "entities.dxf",
      line +
        // a half circle by its bulge, then straight, closed
        "0\nLWPOLYLINE\n8\nJ2\n90\n3\n70\n1\n10\n2\n20\n0\n42\n1\n10\n0\n20\n0"
        "\n10\n1\n20\n-1\n"
        "0\nPOLYLINE\n8\nJ2\n66\n1\n70\n0\n0\nVERTEX\n8\nJ2\n10\n0\n20\n0\n0\n"
        "VERTEX\n8\nJ2\n10\n5\n20\n5\n0\nSEQEND\n"
        "0\nARC\n8\nJ3\n10\n1\n20\n1\n40\n2\n50\n270\n51\n90\n"
        "0\nCIRCLE\n8\nJ3\n10\n1\n20\n1\n40\n0.5\n"
        "0\nTEXT\n8\nJ1\n10\n0\n20\n0\n40\n1\n1\nfault\n");
    const Drawing drawing = read_dxf(file);
    const auto   &curves  = drawing.curves;
    ASSERT_EQ(curves.size(), 5u);
    EXPECT_EQ(curves[0].name, "J1");
    EXPECT_EQ(curves[0].role, CurveRole::joint);
    EXPECT_EQ(curves[0].end(), Point(4., 3.));

    EXPECT_EQ(curves[1].name, "J2");
    ASSERT_EQ(curves[1].pieces.size(), 3u);
    EXPECT_EQ(curves[1].pieces[0].kind, CurvePiece::Kind::arc);
    // counter-clockwise from (2, 0) to (0, 0): over the top
    EXPECT_EQ(curves[1].pieces[0].through, Point(1., 1.));
    EXPECT_NEAR(curves[1].pieces[0].radius, 1., 1e-15);
    EXPECT_TRUE(curves[1].is_closed());

    ASSERT_EQ(curves[2].pieces.size(), 1u);
    EXPECT_EQ(curves[2].end(), Point(5., 5.));

    EXPECT_EQ(curves[3].start(), Point(1., -1.));
    EXPECT_EQ(curves[3].end(), Point(1., 3.));
    EXPECT_EQ(curves[3].pieces[0].through, Point(3., 1.));
    EXPECT_EQ(curves[4].pieces[0].kind, CurvePiece::Kind::circle);
    EXPECT_EQ(curves[4].pieces[0].radius, 0.5);
    expect_parts(drawing.notice, {"1 TEXT", "entities.dxf"});

    EXPECT_EQ(read_dxf(file, {"J2"}).curves.size(), 2u);
    EXPECT_EQ(read_dxf(file, {"J2"}).notice, "");
  }


  // Only what is drawn in model space is geometry, and what is left out is counted.
  TEST(Drawing, WhatIsNotDrawn)
  {
    const std::string layers =
      "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n"
      "0\nLAYER\n2\nFrozen\n70\n1\n62\n7\n0\nLAYER\n2\nOff\n70\n0\n62\n-7\n"
      "0\nLAYER\n2\nLocked\n70\n4\n62\n7\n0\nENDTAB\n0\nENDSEC\n"
      // definitions of blocks are not drawn
      "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nX\n" +
      line + "0\nENDBLK\n0\nENDSEC\n";
    const auto on = [](const std::string &layer, const std::string &more = "") {
      return "0\nLINE\n8\n" + layer + "\n" + more +
             "10\n0\n20\n0\n11\n4\n21\n3\n";
    };
    const std::string file =
      write_drawing("hidden.dxf",
                    on("FROZEN") + on("Off") + on("Locked") +
                      on("J", "67\n1\n") + on("J", "60\n1\n") + on("J") +
                      "0\nMLINE\n8\nJ\n0\nMLINE\n8\nJ\n0\nHELIX\n8\nJ\n"
                      "0\nLINE\n8\nJ\n10\n1\n20\n2\n11\n1\n21\n2\n"
                      "0\nCIRCLE\n8\nJ\n10\n1\n20\n2\n40\n0\n",
                    layers);
    const Drawing drawing = read_dxf(file);
    ASSERT_EQ(drawing.curves.size(), 2u);
    EXPECT_EQ(drawing.curves[0].name, "Locked");
    EXPECT_EQ(drawing.curves[1].name, "J");
    expect_parts(drawing.notice,
                 {"2 LINE on a layer that is frozen or switched off",
                  "1 LINE in paper space",
                  "1 LINE that is invisible",
                  "1 LINE without a length",
                  "1 CIRCLE without a length",
                  "2 MLINE",
                  "1 HELIX"});
    expect_parts(error_of([&]() { read_dxf(file, {"off"}); }),
                 {"'Off'", "frozen or switched off"});
    // A spline in paper space is no reason to refuse the drawing.
    expect_parts(read(line + "0\nSPLINE\n8\nJ1\n67\n1\n").notice,
                 {"1 SPLINE in paper space"});
  }


  TEST(Drawing, PolylinesOfOtherKinds)
  {
    const auto polyline = [](const std::string &flags,
                             const std::string &flags_of_second,
                             const std::string &more = "") {
      return "0\nPOLYLINE\n8\nJ\n66\n1\n70\n" + flags + "\n" + more +
             "0\nVERTEX\n8\nJ\n10\n0\n20\n0\n70\n0\n"
             "0\nVERTEX\n8\nJ\n10\n1\n20\n1\n70\n" +
             flags_of_second +
             "\n0\nVERTEX\n8\nJ\n10\n2\n20\n0\n70\n0\n0\nSEQEND\n";
    };
    // The second vertex is drawn, unless it is a control point of a spline's frame (16).
    EXPECT_EQ(read(polyline("4", "8")).curves[0].pieces.size(), 2u);
    EXPECT_EQ(read(polyline("4", "16")).curves[0].pieces.size(), 1u);
    for (const std::string mesh : {"16", "17", "48"})
    {
      const Drawing drawing = read(polyline(mesh, "64"));
      EXPECT_TRUE(drawing.curves.empty());
      expect_parts(drawing.notice, {"1 POLYLINE that is a polygon mesh"});
    }
    expect_parts(read(polyline("64", "192")).notice, {"polyface mesh"});
    // A polyline in space (8) has coordinates of the drawing, whatever its normal.
    const std::string from_below = "210\n0\n220\n0\n230\n-1\n";
    EXPECT_EQ(read(polyline("8", "32", from_below)).curves[0].end(),
              Point(2., 0.));
    EXPECT_EQ(read(polyline("0", "0", from_below)).curves[0].end(),
              Point(-2., 0.));
  }


  // In a plane that is seen from below, x points to the left.
  TEST(Drawing, PlanesSeenFromBelow)
  {
    const std::string below = "210\n0\n220\n0\n230\n-1\n";
    const auto        arc =
      read("0\nARC\n8\n0\n10\n-5\n20\n5\n40\n2\n50\n0\n51\n90\n" + below)
        .curves[0]
        .pieces[0];
    EXPECT_EQ(arc.start, Point(3., 5.));
    EXPECT_EQ(arc.end, Point(5., 7.));
    EXPECT_NEAR(arc.center.distance(Point(5., 5.)), 0., 1e-14);
    EXPECT_EQ(read("0\nCIRCLE\n8\n0\n10\n-5\n20\n4\n40\n2\n" + below)
                .curves[0]
                .pieces[0]
                .center,
              Point(5., 4.));
    // The half circle lies to the left of the chord when it is mirrored.
    const auto bulge =
      read(
        "0\nLWPOLYLINE\n8\n0\n90\n2\n70\n0\n10\n-2\n20\n0\n42\n1\n10\n0\n20"
        "\n0\n" +
        below)
        .curves[0]
        .pieces[0];
    EXPECT_EQ(bulge.start, Point(2., 0.));
    EXPECT_EQ(bulge.through, Point(1., -1.));
    EXPECT_EQ(bulge.end, Point(0., 0.));
    // Ends of a line are points of the drawing.
    EXPECT_EQ(read(line + below).curves[0].end(), Point(4., 3.));
  }


  TEST(Drawing, FullArcs)
  {
    const auto arc = [](const std::string &first, const std::string &second) {
      return read("0\nARC\n8\n0\n10\n1\n20\n2\n40\n2\n50\n" + first + "\n51\n" +
                  second + "\n")
        .curves[0]
        .pieces[0];
    };
    using Kind = CurvePiece::Kind;
    EXPECT_EQ(arc("0", "360").kind, Kind::circle);
    EXPECT_EQ(arc("0", "360.0000000000001").kind, Kind::circle);
    EXPECT_EQ(arc("360", "0").kind, Kind::circle);
    EXPECT_EQ(arc("90", "450").kind, Kind::circle);
    EXPECT_EQ(arc("-180", "180").center, Point(1., 2.));
    EXPECT_EQ(arc("0", "359").kind, Kind::arc);
    EXPECT_EQ(arc("350", "10").kind, Kind::arc);
  }


  TEST(Drawing, NamesOfLayers)
  {
    const auto on = [](const std::string &layer) {
      return "0\nLINE\n8\n" + layer + "\n10\n0\n20\n0\n11\n4\n21\n3\n";
    };
    const auto name = [&](const std::string &layer,
                          const std::string &page,
                          const std::string &wanted) {
      const std::string file =
        write_drawing("names.dxf",
                      on(layer),
                      header("9\n$DWGCODEPAGE\n3\n" + page + "\n"));
      return read_dxf(file, {wanted}).curves[0].name;
    };
    const std::string spelled =
      "KL\xC3\x9C"
      "FTE";
    for (const std::string &wanted : {spelled,
                                      std::string("kl\xC3\xBC"
                                                  "fte")})
    {
      EXPECT_EQ(name("KL\xDC"
                     "FTE",
                     "ANSI_1252",
                     wanted),
                spelled);
      EXPECT_EQ(name("KL\x9A"
                     "FTE",
                     "dos850",
                     wanted),
                spelled);
      EXPECT_EQ(name("KL\\U+00DCFTE", "ANSI_1252", wanted), spelled);
      EXPECT_EQ(name(spelled, "ANSI_1252", wanted), spelled);
    }
    // Cyrillic, in the code page of Windows
    EXPECT_EQ(name("\xD8\xE2", "ANSI_1251", "\xD1\x88\xD0\xB2"),
              "\xD0\xA8\xD0\xB2");
    EXPECT_EQ(name("joints", "ANSI_1252", "JOINTS"), "joints");
    expect_parts(error_of([&]() { name("Fault", "ANSI_1252", "Joint"); }),
                 {"'Joint'", "'Fault'"});
  }


  TEST(Drawing, Units)
  {
    const auto unit = [](const std::string &number) {
      return read_dxf(
               write_drawing("units.dxf",
                             line,
                             header("9\n$INSUNITS\n70\n" + number + "\n")))
        .unit;
    };
    EXPECT_EQ(unit("0"), "");
    EXPECT_EQ(unit("4"), "mm");
    EXPECT_EQ(unit("6"), "m");
    EXPECT_EQ(read(line).unit, "");
  }


  TEST(Drawing, BadFiles)
  {
    const auto expect = [](const std::string              &file,
                           const std::vector<std::string> &parts,
                           const std::vector<std::string> &layers = {}) {
      SCOPED_TRACE(file);
      expect_parts(error_of([&]() { read_dxf(file, layers); }), parts);
    };
    expect("no-such.dxf", {"no-such.dxf", "does not exist"});
    expect("/dev/zero", {"/dev/zero", "no ordinary file"});
    expect(write_drawing("empty.dxf", ""), {"empty.dxf", "no lines"});
    expect(write_drawing("layer.dxf", line),
           {"'J9'", "layer.dxf", "'J1'"},
           {"J9"});
    expect(write_drawing("spline.dxf", line + "0\nSPLINE\n8\nJ1\n70\n8\n"),
           {"SPLINE", "'J1'", "spline.dxf", "polyline"});
    expect(write_drawing("flat.dxf",
                         "0\nCIRCLE\n8\nJ1\n10\n1\n20\n1\n40\n0.5\n210\n0\n220"
                         "\n1\n230\n0\n"),
           {"CIRCLE", "plane", "flat.dxf"});
    expect(write_drawing("lacks.dxf", "0\nLINE\n8\nJ1\n10\n0\n20\n0\n11\n4\n"),
           {"LINE", "group 21", "lacks.dxf:6"});
    expect(write_drawing("code.dxf", line + "LINE\n8\n"),
           {"'LINE'", "group code", "code.dxf:17"});
    expect(write_file("text.dxf", "this is\nno drawing\nat all\n"),
           {"text.dxf", "no DXF drawing"});
    expect(write_file("half.dxf", "0\nSECTION\n2\nENTITIES\n" + line),
           {"half.dxf", "ends early"});
  }


  // Numbers are those that C++ writes, of a size to compute with.
  TEST(Drawing, NumbersThatAreNone)
  {
    for (const std::string number : {"abc",
                                     "nan",
                                     "-inf",
                                     "0x10",
                                     "1e400",
                                     "1e999",
                                     "1e160",
                                     "1,5",
                                     "1.5.2",
                                     ""})
      expect_parts(error_of([&]() {
                     read("0\nLINE\n8\nJ1\n10\n" + number +
                          "\n20\n0\n11\n4\n21\n3\n");
                   }),
                   {"'" + number + "'", "number", "drawing.dxf:10"});
    EXPECT_EQ(read("0\nLINE\n8\nJ1\n10\n+1.5E+0\n20\n -2. \n11\n4\n21\n3\n")
                .curves[0]
                .start(),
              Point(1.5, -2.));
  }
} // namespace
