// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/field_text.hpp"

#include <gtest/gtest.h>

namespace clatter::mesh::deck {
namespace {

TEST(DeckNumbers, AreReadAsCFortranAndNastranWriteThem) {
  EXPECT_EQ(to_number("1.5"), 1.5);
  EXPECT_EQ(to_number(".5"), 0.5);
  EXPECT_EQ(to_number("+.5"), 0.5);
  EXPECT_EQ(to_number("-.5"), -0.5);
  EXPECT_EQ(to_number("7."), 7.0);
  EXPECT_EQ(to_number("70"), 70.0);
  EXPECT_EQ(to_number("+2"), 2.0);
  EXPECT_EQ(to_number("-1.5E-3"), -1.5e-3);
  EXPECT_EQ(to_number("1.05E+7"), 1.05e7);
  EXPECT_EQ(to_number("1D3"), 1000.0);
  EXPECT_EQ(to_number("1.25d-2"), 0.0125);
  EXPECT_EQ(to_number("1.5-3"), 1.5e-3);
  EXPECT_EQ(to_number("1.+5"), 1e5);
  EXPECT_EQ(to_number("-2.+5"), -2e5);
  EXPECT_EQ(to_number("-1.25+12"), -1.25e12);
  EXPECT_EQ(to_number("-2.1854783949-15"), -2.1854783949e-15);
  EXPECT_EQ(to_number("12345678901234567e-19"), 12345678901234567e-19);
  EXPECT_EQ(to_integer("+17"), 17);
  EXPECT_EQ(to_integer("-1"), -1);
}

TEST(DeckNumbers, ThatAreTooSmallForADoubleAreZero) {
  EXPECT_EQ(to_number("1e-400"), 0.0);
  EXPECT_EQ(to_number("1.-400"), 0.0);
}

TEST(DeckNumbers, WhatIsNoFiniteNumberIsNone) {
  for (const char* text :
       {"",      ".",     "+",   "-",    "x",    "1x",  "1.5.2", "1..",     "e5",
        "1e",    "1e+",   "1-",  "1.5-", "1. 5", "1 2", "--1",   "+-1",     "1e5e5",
        "1e999", "1e309", "nan", "inf",  "0x10", "1,5", "1-2-3", "1e308e1", "1.5-3-2"}) {
    EXPECT_FALSE(to_number(text).has_value()) << text;
  }
  for (const char* text : {"", "1.", "1e3", "a", "+", "2147483648", "1 2", "+-1"}) {
    EXPECT_FALSE(to_integer(text).has_value()) << text;
  }
}

TEST(DeckText, IsShownShortAndPrintable) {
  EXPECT_EQ(shown("a b"), "'a b'");
  EXPECT_EQ(shown("a\x01z\xff"), "'a?z?'");
  EXPECT_EQ(shown(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(DeckText, IsFoldedToCapitalsWithoutBlanks) {
  EXPECT_EQ(folded(" Solid  section\t"), "SOLIDSECTION");
  EXPECT_EQ(capitals(" Solid  section"), " SOLID  SECTION");
  EXPECT_EQ(trimmed(" \t a b \r"), "a b");
}

}  // namespace
}  // namespace clatter::mesh::deck
