# Work-precision diagram: error against cost of every attempt at one case, from results.csv.
#   gnuplot -c work_precision.gp RESULTS.csv CASE TITLE "CONTESTANT …" OUT YLABEL
load ARG0[:strstrt(ARG0, "work_precision.gp") - 1] . "style.gp"
csv = ARG1
case = ARG2
contestants = ARG4
out = ARG5

set title ARG3 noenhanced
set xlabel "cost: µs of one core per simulated second"
set ylabel ARG6 noenhanced
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set yrange [1e-17 : 1e2]
# A logarithmic scale has no zero: an error of 0 is drawn at the lower end.
shown(e) = e > 1e-16 ? (e < 1e2 ? e : 1e2) : 1e-16

do for [kind in "svg png"] {
  if (kind eq "svg") { eval svg(820, 480) } else { eval png(820, 480) }
  plot for [name in contestants] csv every ::1 \
    using (strcol(1) eq case && strcol(2) eq name && strlen(strcol(5)) > 0 ? column(6) : NaN):(shown(column(5))) \
    with linespoints lc rgb colourOf(name) pt pointOf(name) ps sizeOf(name) title name noenhanced
  unset output
}
