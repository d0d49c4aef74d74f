; program engrave, SINUMERIK 840D
; part engrave, aluminium, 4 mm thick
; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
; origin: axis of the part, Z0 on top of the stock
; drills go 1.80 mm below the stock: leave room under the holes
; origin G54, Z0 on top of the stock, units mm and mm/min
; T7 D 5 mm: drill-5, drill
; T41 D 3 mm: engrave-3, chamfer mill
G17 G710 G40 G90 G94 COMPOF
G64
G0 SUPA Z0 D0
; operation: drill 5
T7
M6
G54 S5093 M3
G0 X-14 Y0
D1 Z5
M8
Z1
G1 Z-5.803 F376
G0 Z5
M9
M5
G0 SUPA Z0 D0
; operation: number: engrave
T41
M6
G54 S12000 M3
G0 X-9.667 Y-2.5
D1 Z5
M8
Z1
G1 Z0 F120
Z-0.2 F36
Y2.5 F120
X-8 Y0
X-6.333 Y2.5
Y-2.5
G0 Z5
X-4.667 Y2.5
Z1
G1 Z0
Z-0.2 F36
X-3.833 Y-2.5 F120
X-3 Y0
X-2.167 Y-2.5
X-1.333 Y2.5
G0 Z5
X1.167 Y0
Z1
G1 Z0
Z-0.2 F36
X2.833 F120
G0 Z5
X5.333 Y1.667
Z1
G1 Z0
Z-0.2 F36
X6.167 Y2.5 F120
X7.833
X8.667 Y1.667
Y0.833
X5.333 Y-2.5
X8.667
G0 Z5
X13.667 Y2.5
Z1
G1 Z0
Z-0.2 F36
X10.333 F120
Y0.833
X12.833
X13.667 Y0
Y-1.667
X12.833 Y-2.5
X10.333
G0 Z5
M9
M5
G0 SUPA Z0 D0
M30
