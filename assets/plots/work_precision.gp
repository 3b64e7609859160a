# Work-precision diagram: error against cost of every attempt at one case.
#   texts.txt   title, label of the errors, contestants
#   data.txt    contestant (from 1), cost, error
load "style.gp"
set title texts[1] noenhanced
set xlabel "cost: µs of one core per simulated second"
set ylabel texts[2] noenhanced
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set yrange [1e-17 : 1e2]
# A logarithmic scale has no zero: an error of 0 is drawn at the lower end.
shown(e) = e > 1e-16 ? (e < 1e2 ? e : 1e2) : 1e-16

do for [kind in "svg png"] {
  if (kind eq "svg") { eval svg(820, 480) } else { eval png(820, 480) }
  plot for [k = 3:lines] "data.txt" using (column(1) == k - 2 ? column(2) : NaN):(shown(column(3))) \
    with linespoints lc rgb colourOf(texts[k]) pt pointOf(texts[k]) ps sizeOf(texts[k]) title texts[k] noenhanced
  unset output
}
