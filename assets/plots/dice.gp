# Part of the throws that end with a square face up, over the shape of the die, with bands of 95 %.
#   texts.txt   title, then a label for each series
#   data.txt    series (0: measured, 1: the usual throw, from 2 on: others), x/y, part, low, high
load "style.gp"
# Before the range is set: stats ignores what lies outside it.
stats "data.txt" using 1 nooutput
series = int(STATS_max)
set title texts[1] noenhanced
set xlabel "x/y"
set ylabel "part with a square face up"
set yrange [0 : 1]
shown(k, c) = column(1) == k ? column(c) : NaN
# gnuplot asks for one title more than it draws series.
label(n) = n > series ? "" : texts[2 + n]
shades = "#4477aa #228833 #aa3377 #66ccee #ccbb44 #332288"

do for [kind in "svg png"] {
  if (kind eq "svg") { eval svg(900, 480) } else { eval png(900, 480) }
  plot "data.txt" using (shown(1, 2)):4:5 with filledcurves lc rgb "#f0c9c0" notitle, \
    for [n = 2:series] "data.txt" using (shown(n, 2)):3 with lines lc rgb word(shades, 1 + (n - 2) % 6) title label(n) noenhanced, \
    "data.txt" using (shown(1, 2)):3 with lines lw 2 lc rgb "#c8553d" title texts[3] noenhanced, \
    "data.txt" using (shown(0, 2)):3:4:5 with yerrorbars pt 7 ps 0.7 lc rgb "#222222" title texts[2] noenhanced
  unset output
}
