; program spot, SINUMERIK 840D
; part spot, aluminium, 4 mm thick
; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
; origin: axis of the part, Z0 on top of the stock
; drills go 1.80 mm below the stock: leave room under the holes
; origin G54, Z0 on top of the stock, units mm and mm/min
; T1 D 6 mm: spot-6, spot drill
; T7 D 5 mm: drill-5, drill
G17 G710 G40 G90 G94 COMPOF
G64
G0 SUPA Z0 D0
; operation: spot drill
T1
M6
G54 S3714 M3
G0 X-10 Y5
D1 Z5
M8
Z1
G1 Z-1.5 F222
G4 F0.2
G0 Z5
X10 Y-5
Z1
G1 Z-1.5
G4 F0.2
G0 Z5
M9
M5
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
M30
