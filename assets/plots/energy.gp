# Energy over time at the usual time step of one case, from energy.csv.
#   gnuplot -c energy.gp ENERGY.csv CASE TITLE "CONTESTANT …" OUT
load ARG0[:strstrt(ARG0, "energy.gp") - 1] . "style.gp"
csv = ARG1
case = ARG2
contestants = ARG4
out = ARG5

set title ARG3 noenhanced
set xlabel "time [s]"
set ylabel "relative change of energy"
set logscale y
set format y "10^{%T}"
set yrange [1e-17 : 1e3]
shown(e) = abs(e) > 1e-16 ? abs(e) : 1e-16

do for [kind in "svg png"] {
  if (kind eq "svg") { eval svg(820, 480) } else { eval png(820, 480) }
  plot for [name in contestants] csv every ::1 \
    using (strcol(1) eq case && strcol(2) eq name ? column(3) : NaN):(shown(column(4))) \
    with linespoints lc rgb colourOf(name) pt pointOf(name) ps 0.6 title name noenhanced
  unset output
}
