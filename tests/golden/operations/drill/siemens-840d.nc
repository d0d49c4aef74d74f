; program drill, SINUMERIK 840D
; part drill, aluminium, 4 mm thick
; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
; origin: axis of the part, Z0 on top of the stock
; drills go 2.70 mm below the stock: leave room under the holes
; origin G54, Z0 on top of the stock, units mm and mm/min
; T7 D 5 mm: drill-5, drill
; T9 D 8 mm: drill-8, drill
G17 G710 G40 G90 G94 COMPOF
G64
G0 SUPA Z0 D0
; operation: drill 5
T7
M6
G54 S5093 M3
G0 X-10 Y5
D1 Z5
M8
Z1
G1 Z-5.803 F376
G0 Z5
X10 Y-5
Z1
G1 Z-5.803
G0 Z5
M9
M5
G0 SUPA Z0 D0
; operation: drill 8
T9
M6
G54 S3183 M3
G0 X10 Y8
D1 Z5
M8
Z1
G1 Z-6.704 F381
G0 Z5
M9
M5
G0 SUPA Z0 D0
M30
