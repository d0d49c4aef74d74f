; program peck, SINUMERIK 840D
; part peck, aluminium, 18 mm thick
; stock 40.00 x 30.00 x 18 mm, from X-20.000 Y-15.000
; origin: axis of the part, Z0 on top of the stock
; drills go 1.20 mm below the stock: leave room under the holes
; origin G54, Z0 on top of the stock, units mm and mm/min
; T4 D 3 mm: drill-3, drill
G17 G710 G40 G90 G94 COMPOF
G64
G0 SUPA Z0 D0
; operation: drill 3
T4
M6
G54 S8488 M3
G0 X-10 Y5
D1 Z5
M8
Z1
G1 Z-2 F373
G0 Z1
Z-1.75
G1 Z-5
G0 Z1
Z-4.75
G1 Z-8
G0 Z1
Z-7.75
G1 Z-11
G0 Z1
Z-10.75
G1 Z-14
G0 Z1
Z-13.75
G1 Z-17
G0 Z1
Z-16.75
G1 Z-19.202
G0 Z5
X10 Y-5
Z1
G1 Z-2
G0 Z1
Z-1.75
G1 Z-5
G0 Z1
Z-4.75
G1 Z-8
G0 Z1
Z-7.75
G1 Z-11
G0 Z1
Z-10.75
G1 Z-14
G0 Z1
Z-13.75
G1 Z-17
G0 Z1
Z-16.75
G1 Z-19.202
G0 Z5
M9
M5
G0 SUPA Z0 D0
M30
