// Monte Carlo measures of the estimators' accuracy, honesty and cost on simulated bearings. Each
// prints its table and holds what comes out against its limits. Deterministic by the number of
// runs.
#pragma once

#include <string>

#include "dev/estimators/limits.h"

namespace ols::bench {

// One epoch, many geometries: the joint least squares against the Cramer-Rao bound at the truth.
void least_squares_bound(int runs, Limits& limits);

// The filter against the posterior bound, with biases that stay or wander; alone, and configured
// for the case that a bias may stay for hours.
void filter_bounds(int runs, Limits& limits);

// A drone that manoeuvres at 200 to 800 m, four stations, against the paper's estimator: live, each
// from the bearings that have come in by then.
void against_paper(int runs, Limits& limits);

// Crossing targets with misses and false bearings.
void several(int runs, Limits& limits);

// Traffic that detectors see: ten crossing targets, four stations that stare, tracklets with
// misses, breaks, and false ones. How many are found, how often identities change, ghosts an hour.
void traffic(int runs, Limits& limits);

// A target that detectors find: how long until it is confirmed, and until the stations that turn
// have it from an overview station, with automatic hand-over.
void handover(int runs, Limits& limits);

// Meteors, which no drone's recording stands for: 0.3 to 5 s of 10 to 70 km/s at 80 to 200 km, 2 to
// 6 cameras that state nothing but their noise. The recorded filter and its smoother against least
// squares at the same instants.
void meteors(int runs, Limits& limits);

// Stations that have no errors but noise, and state nothing else: whatever the filter allows for
// costs it nothing there. A manoeuvring drone for 12 s, 2, 3, 4, 12 and 100 stations on a circle of
// 250 m at 15 Hz: the recorded filter and its smoother against least squares at the same instants.
// Beside it, without a limit, one that hardly manoeuvres, at 30 Hz.
void noise_only(int runs, Limits& limits);

// What simulated objects of known class are taken for after ten seconds, by their size in pixels:
// tracks of another seed than those of central/classify/class_table.h, and with errors.
void classes(int runs, Limits& limits);
// The true features of simulated tracks, as dev/python/ols_class_table.py reads them.
void write_class_looks(const std::string& file, int runs);

// What a bearing costs in the fusion, a line for each site: processor time. Up to 1000 stations,
// eight on a target; and up to 100 that are all on the same target or targets.
void cost(Limits& limits);

}  // namespace ols::bench
