# Correct digits of every contestant in every case.
#   texts.txt   title
#   data.txt    row, column (from 0), "=" and case, "=" and contestant, digits, error
load "style.gp"
stats "data.txt" using 1:2 nooutput
rows = int(STATS_max_x) + 1
columns = int(STATS_max_y) + 1

set title texts[1] noenhanced
unset key
unset grid
set xrange [-0.5 : columns - 0.5]
set yrange [rows - 0.5 : -0.5]
set xtics rotate by 45 right noenhanced scale 0
set ytics noenhanced scale 0
set cbrange [0 : 16]
set cblabel "correct digits"
set palette defined (0 "#b2182b", 3 "#ef8a62", 6 "#fddbc7", 9 "#d1e5f0", 12 "#67a9cf", 16 "#2166ac")

do for [kind in "svg png"] {
  width = 330 + 66 * columns
  height = 190 + 22 * rows
  if (kind eq "svg") { eval svg(width, height) } else { eval png(width, height) }
  set lmargin at screen 205.0 / width
  set rmargin at screen 1 - 105.0 / width
  set tmargin at screen 1 - 40.0 / height
  set bmargin at screen 130.0 / height
  set colorbox user origin 1 - 90.0 / width, 130.0 / height size 25.0 / width, 1 - 170.0 / height
  plot "data.txt" using 2:1:(0.5):(0.5):(column(5) >= 0 ? column(5) : NaN):xticlabels(strcol(4)[2:]):yticlabels(strcol(3)[2:]) \
      with boxxyerror fillstyle solid noborder fillcolor palette, \
    "data.txt" using 2:1:6 with labels font ",9" noenhanced
  unset output
}
